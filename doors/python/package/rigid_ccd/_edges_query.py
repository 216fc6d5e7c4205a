"""A question about a robot's edges that can be pickled, for distributed engines."""

import copy
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError
from ._query import like
from ._rigid_ccd import Cell, Table

PathQuestion: TypeAlias = Literal["is-free", "first-contact", "closest-approach"]


class EdgesQuery:
    """A callable that answers a question about each edge in a table of a robot's edges.

    Pass it as a function of tables to Ray Data's `map_batches`, Dask's `map_partitions`, Spark's `mapInArrow`, or a
    pool of processes. It can be pickled, with its cell.

    A table has a column `id`, and for each joint the columns `from_JOINT` and `to_JOINT`, as for `ccd edges`. With the
    suffix `_deg` they are in degrees. The results are a table of the same kind, with the ids and the columns of
    `Cell.answer_edges`. For an iterator of tables, the result is an iterator of tables.

    Args:
        cell: the cell. It is copied: later changes have no effect.
        question: "is-free", "first-contact" or "closest-approach".
        rest: the positions of joints that have no columns in the tables, by name.
        settings: the same as for `Cell.answer_edges`. `threads` is 1 by default, because engines start a task for each core.

    >>> from rigid_ccd import Body, Cell, EdgesQuery, Joint, Robot
    >>> slider = Joint.prismatic("x", "rail", "cart", axis=[1, 0, 0])
    >>> cell = Cell(Robot([slider], {"cart": Body.sphere(0.5)}))
    >>> cell.add_obstacle("wall", Body.box(0.1, 5, 5), ([3, 0, 0], [0, 0, 0, 1]))
    >>> EdgesQuery(cell)({"id": ["near", "far"], "from_x": [0, 0], "to_x": [1, 4]})["status"]
    array(['free', 'contact'], dtype=object)
    """

    def __init__(
        self, cell: Cell, question: PathQuestion = "is-free", *, rest: Mapping[str, float] | None = None, **settings: Any
    ) -> None:
        # A copy, so that later changes of the cell have no effect.
        self._cell: Cell = copy.copy(cell)
        self._question, self._rest = question, {joint: _position(joint, position) for joint, position in (rest or {}).items()}
        self._settings = {"threads": 1, **settings}
        unknown = set(self._rest) - set(cell.robot.joint_names)
        if unknown:
            raise InputError(f"rest: there is no joint {', '.join(sorted(unknown))}")
        # Invalid settings raise an exception here, and not on a worker.
        self._answer(np.zeros((2, 0, len(cell.robot.joint_names))))

    def __call__(self, edges: Any) -> Any:
        """Answers a table, or an iterator of tables."""
        if isinstance(edges, Iterator) and not hasattr(edges, "__arrow_c_stream__"):
            return self._each(edges)
        table = self._table(edges)
        return like(edges, table._column_before("id", self._answer(self._configurations(table))))

    def schema(self, edges: Any) -> Any:
        """Returns an empty table with the columns of the results. For a pyarrow.Schema, returns a pyarrow.Schema."""
        if hasattr(edges, "empty_table"):
            return self.schema(edges.empty_table()).schema
        empty = self._table(edges).take([])
        return like(edges, empty._column_before("id", self._answer(self._configurations(empty))))

    def _each(self, tables: Iterable[Any]) -> Iterator[Any]:
        for edges in tables:
            yield self(edges)

    def _table(self, edges: Any) -> Table:
        table = Table(edges)
        if "id" not in table:
            raise InputError("edges: no column `id`: engines return rows in any order")
        return table

    def _configurations(self, table: Table) -> NDArray[np.float64]:
        robot, names = self._cell.robot, table.column_names
        joints = robot.joint_names
        ends = np.empty((2, len(table["id"]), len(joints)))
        known, missing = {"id"}, []
        for k, joint in enumerate(joints):
            for end, prefix in enumerate(("from_", "to_")):
                column = robot._joint_column(names, prefix, joint)
                if column is None and joint in self._rest:
                    ends[end, :, k] = self._rest[joint]
                elif column is None:
                    missing.append(prefix + joint)
                elif joint in self._rest:
                    raise InputError(f"edges: {joint} has columns, but also a position in `rest`")
                else:
                    name, is_in_degrees = column
                    positions = _numbers(table, name)
                    ends[end, :, k] = np.deg2rad(positions) if is_in_degrees else positions
                    known.add(name)
        if missing:
            raise InputError(f"edges: no column {', '.join(missing)}; `rest` gives positions to joints without columns")
        if unknown := set(table) - known:
            raise InputError(f"edges: unknown column {', '.join(sorted(unknown))}")
        return ends

    def _answer(self, ends: NDArray[np.float64]) -> Table:
        return self._cell.answer_edges(ends[0], ends[1], question=self._question, **self._settings)

    def __repr__(self) -> str:
        settings = "".join(f", {name}={value!r}" for name, value in self._settings.items())
        return f"EdgesQuery({self._cell!r}, question={self._question!r}, rest={self._rest!r}{settings})"


def _position(joint: str, position: Any) -> float:
    if isinstance(position, (str, bytes, bool, np.bool_)):
        raise InputError(f"rest: {joint}: a number is needed, not {position!r}")
    return float(position)


def _numbers(table: Table, name: str) -> NDArray[Any]:
    column = table[name]
    if column.dtype.kind not in "fiu":
        raise InputError(f"edges: column {name}: numbers are needed, not {column.dtype}")
    return column
