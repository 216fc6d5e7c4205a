"""A question about two bodies that can be pickled, for distributed engines."""

import os
import pickle
import sys
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any, Literal, TypeAlias

from ._errors import InputError
from ._rigid_ccd import Body, Table
from ._tables import Question, answer

BodyOrFile: TypeAlias = Body | str | os.PathLike[str]


class TableQuery:
    """A callable that answers a question about two bodies for each row of a table of motions.

    Pass it as a function of tables to Ray Data's `map_batches`, Dask's `map_partitions`, Spark's `mapInArrow`, or a
    pool of processes. It can be pickled. Each process loads or unpickles a body once.

    For a table, the results are a table of the same kind: pyarrow, pandas, polars or a dict of NumPy arrays. For other
    tables, they are a `Table`. For an iterator of tables, the result is an iterator of tables. The types of columns do
    not depend on values, except in a dict. A pandas frame keeps its index.

    Tables need a column `id`, because engines split a table anywhere, and return the parts in any order.

    Args:
        a, b: bodies, or the paths of mesh files or prepared bodies (`Body.save`), which each process reads.
        question: "first-contact", "is-free", "contact-interval", "closest-approach" or
            "distance".
        paths: "refused" refuses tables with a column t. If an engine split a path, the interval between its parts would
            not be checked. "whole" asserts that all rows of an id are in one table, as after a group-by.
        settings: the same as for `first_contacts` or `closest_approaches`. `threads` is 1 by default, because engines start a
            task for each core. `micros` is False by default, so that equal answers give equal tables.

    >>> import pickle
    >>> from rigid_ccd import Body, TableQuery
    >>> query = pickle.loads(pickle.dumps(TableQuery(Body.sphere(0.5), Body.box(0.1, 5, 5))))
    >>> query({"id": [7, 8], "a_px": [-3, -3], "a_vx": [4, 1]})["status"]
    array(['contact', 'free'], dtype=object)
    """

    def __init__(
        self,
        a: BodyOrFile,
        b: BodyOrFile,
        *,
        question: Question = "first-contact",
        paths: Literal["refused", "whole"] = "refused",
        **settings: Any,
    ) -> None:
        self._a, self._b, self._question, self._paths = a, b, question, paths
        self._settings = {"threads": 1, "micros": False, **settings}
        # Invalid arguments raise an exception here, and not on a worker. Files need to exist on the workers only.
        for body in (a, b):
            if not isinstance(body, (Body, str, os.PathLike)):
                raise TypeError(f"a, b: a Body or the path of a file is needed, not {type(body).__name__}")
        if paths not in ("refused", "whole"):
            raise InputError(f"paths: `refused` or `whole` is needed, not `{paths}`")
        answer(self._question, _PLACEHOLDER_BODY, _PLACEHOLDER_BODY, {"a_px": []}, **self._settings)

    def __call__(self, motions: Any) -> Any:
        """Answers a table, or an iterator of tables."""
        if isinstance(motions, Iterator) and not hasattr(motions, "__arrow_c_stream__"):
            return self._each(motions)
        table = self._table(motions)
        return like(motions, answer(self._question, _body(self._a), _body(self._b), table, **self._settings))

    def schema(self, motions: Any) -> Any:
        """Returns an empty table with the columns of the results, without loading the bodies.

        The table has the same kind as `motions`. For a pyarrow.Schema, returns a pyarrow.Schema.
        """
        if hasattr(motions, "empty_table"):
            return self.schema(motions.empty_table()).schema
        empty = self._table(motions).take([])
        return like(motions, answer(self._question, _PLACEHOLDER_BODY, _PLACEHOLDER_BODY, empty, **self._settings))

    def _each(self, tables: Iterable[Any]) -> Iterator[Any]:
        for motions in tables:
            yield self(motions)

    def _table(self, motions: Any) -> Table:
        """Converts motions to a `Table`.

        Raises:
            InputError: there is no column `id`, or there is a column `t` without paths='whole', because an engine may
                split a path's rows between partitions.
        """
        table = Table(motions)
        if "id" not in table:
            raise InputError("motions: no column `id`: engines return rows in any order")
        if "t" in table and self._paths != "whole":
            raise InputError(
                "motions: column `t`: engines split paths; group the rows by id, and pass paths='whole' to TableQuery"
            )
        return table

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_a": _packed(self._a), "_b": _packed(self._b)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state, _a=_unpacked(state["_a"]), _b=_unpacked(state["_b"]))

    def __repr__(self) -> str:
        settings = "".join(f", {name}={value!r}" for name, value in self._settings.items())
        return f"TableQuery({self._a!r}, {self._b!r}, question={self._question!r}, paths={self._paths!r}{settings})"


_PLACEHOLDER_BODY = Body.sphere(0)


def _body(body: BodyOrFile) -> Body:
    if isinstance(body, Body):
        return body
    status = os.stat(body)
    return _load(os.fspath(body), (status.st_mtime_ns, status.st_size))


@lru_cache(maxsize=32)
def _load(path: str, _time_and_size: tuple[int, int]) -> Body:
    """Loads a file, or returns the cached body if the time of modification and the size of the file are unchanged."""
    return Body.from_file(path)


def _packed(body: BodyOrFile) -> bytes | str | os.PathLike[str]:
    return pickle.dumps(body) if isinstance(body, Body) else body


def _unpacked(packed: bytes | str | os.PathLike[str]) -> BodyOrFile:
    return _unpickle(packed) if isinstance(packed, bytes) else packed


@lru_cache(maxsize=32)
def _unpickle(pickled: bytes) -> Body:
    """Unpickles a body once per process."""
    body: Body = pickle.loads(pickled)
    return body


def _library(motions: Any) -> str:
    """Returns the name of the library that defines the class of a table, or its base class."""
    modules = [base.__module__.partition(".")[0] for base in type(motions).__mro__]
    return next((name for name in modules if name in ("pyarrow", "pandas", "polars")), modules[0])


def like(motions: Any, results: Table) -> Any:
    """Converts results to the kind of table that the motions are."""
    library = _library(motions)
    if library == "pyarrow":
        pyarrow: Any = sys.modules["pyarrow"]
        table = pyarrow.record_batch(results)
        return table if isinstance(motions, pyarrow.RecordBatch) else pyarrow.Table.from_batches([table])
    if library == "pandas":
        return _frame(motions, results)
    if library == "polars":
        return sys.modules["polars"].DataFrame(results)
    if isinstance(motions, Mapping):
        return dict(results)
    return results


def _frame(motions: Any, results: Table) -> Any:
    """Makes a pandas frame whose types do not depend on values, so that parts of a table can be concatenated."""
    text = "str" if int(sys.modules["pandas"].__version__.partition(".")[0]) >= 3 else "string"
    types = {name: text for name in ("status", "a", "b", "feature_a", "feature_b", "reason")}
    types |= {name: "Int64" for name in ("iterations", "oracle_calls")}
    frame = sys.modules["pandas"].DataFrame(dict(results))
    frame = frame.astype({name: kind for name, kind in types.items() if name in frame})
    ids = motions["id"] if "id" in motions else motions.index.get_level_values("id").to_series()
    # A table of paths has fewer results than rows.
    frame["id"] = ids.array if len(ids) == len(frame) else frame["id"].astype(ids.dtype)
    if "id" in motions.index.names:
        return frame.set_index("id")
    return frame.set_axis(motions.index) if len(motions) == len(frame) else frame
