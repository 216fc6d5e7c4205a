"""A question that engines of many machines can carry to their workers."""

import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any, TypeAlias

from ._rigid_ccd import Body, Table
from ._tables import Ask, answer

BodyOrFile: TypeAlias = Body | str | os.PathLike[str]


class TableQuery:
    """A question about two bodies, asked of one table of motions after another.

    It is a callable that goes where functions of tables go: Ray Data's `map_batches`, Dask's `map_partitions`, Spark's
    `mapInArrow`, a pool of processes. It can be pickled. Each process loads or unpickles a body once.

    Called with a table it returns the results as a table of the same kind: pyarrow, pandas, polars, a dict of NumPy
    arrays, else a `Table`. Called with an iterator of tables it returns an iterator of tables.

    Args:
        a, b: bodies, or the paths of mesh files or prepared bodies (`Body.save`), which each process reads.
        ask: "first-contact", "is-free", "contact-interval", "closest-approach" or "distance".
        settings: those of `first_contacts` or `closest_approaches`. Engines start a task for each core: so `threads` is
            1 by default. `micros` is False: equal answers are equal tables.

    >>> import pickle
    >>> from rigid_ccd import Body, TableQuery
    >>> query = pickle.loads(pickle.dumps(TableQuery(Body.sphere(0.5), Body.box(0.1, 5, 5))))
    >>> query({"id": [7, 8], "a_px": [-3, -3], "a_vx": [4, 1]})["status"]
    array(['contact', 'free'], dtype=object)
    """

    def __init__(self, a: BodyOrFile, b: BodyOrFile, *, ask: Ask = "first-contact", **settings: Any) -> None:
        self._a, self._b, self._ask = a, b, ask
        self._settings = {"threads": 1, "micros": False, **settings}
        # What is wrong with the question is wrong here, not on a worker. Files may be there alone.
        if isinstance(a, Body) and isinstance(b, Body):
            answer(self._ask, a, b, {"a_px": []}, **self._settings)

    def __call__(self, motions: Any) -> Any:
        """Answers a table, or an iterator of tables."""
        if isinstance(motions, Iterator) and not hasattr(motions, "__arrow_c_stream__"):
            return self._each(motions)
        results = answer(self._ask, _body(self._a), _body(self._b), motions, **self._settings)
        return _like(motions, results)

    def schema(self, motions: Any) -> Table:
        """Returns a table without rows that has the columns of the results for such motions; pyarrow.schema takes it."""
        empty = Table(motions).take([])
        return answer(self._ask, _NOTHING, _NOTHING, empty, **self._settings)

    def _each(self, tables: Iterable[Any]) -> Iterator[Any]:
        for motions in tables:
            yield self(motions)

    def __repr__(self) -> str:
        settings = "".join(f", {name}={value!r}" for name, value in self._settings.items())
        return f"TableQuery({self._a!r}, {self._b!r}, ask={self._ask!r}{settings})"


_NOTHING = Body.sphere(0)


def _body(given: BodyOrFile) -> Body:
    return given if isinstance(given, Body) else _load(os.fspath(given), os.stat(given).st_mtime_ns)


@lru_cache(maxsize=32)
def _load(path: str, _changed: int) -> Body:
    """Loads a file, again only if it has changed."""
    return Body.from_file(path)


def _like(motions: Any, results: Table) -> Any:
    """Makes results a table of the kind that the motions are."""
    kind = type(motions)
    library = kind.__module__.partition(".")[0]
    if library == "pyarrow":
        pyarrow: Any = sys.modules["pyarrow"]
        table = pyarrow.record_batch(results)
        return table if isinstance(motions, pyarrow.RecordBatch) else pyarrow.Table.from_batches([table])
    if library == "pandas":
        return kind(dict(results))
    if library == "polars":
        return sys.modules["polars"].DataFrame(results)
    if isinstance(motions, Mapping):
        return dict(results)
    return results
