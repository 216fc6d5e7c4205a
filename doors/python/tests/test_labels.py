"""Labels of data frames and other containers must be names of the joints, because NumPy drops them."""

from collections import UserList, deque, namedtuple
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from test_arrays import CELL, PATH, READS, ROBOT, Own, Polynomials

from rigid_ccd import Body, Cell, InputError, Joint, Robot

pandas: Any = pytest.importorskip("pandas")
polars: Any = pytest.importorskip("polars")
pyarrow: Any = pytest.importorskip("pyarrow")
xarray: Any = pytest.importorskip("xarray")

Rows = list[list[float]]
JOINTS = ["x", "y"]

# All arguments that are configurations, as in `READS`. Arrays are square if possible, so that rows could be mistaken
# for columns.
KINDS = ["path", "configuration", "ranges", "proofs", "edges from", "edges to", "paths", "place", "start", "end", "coefficients"]


def frame(rows: Rows, names: list[Any]) -> Any:
    return pandas.DataFrame(rows, columns=names)


def tuples(rows: Rows, names: list[Any]) -> Any:
    if not all(isinstance(name, str) and name.isidentifier() for name in names):
        pytest.skip("no names of fields")
    row = namedtuple("row", names)  # type: ignore[misc]
    return [row(*values) for values in rows]


def structured(rows: Rows, names: list[Any]) -> Any:
    return np.array([tuple(row) for row in rows], [(str(name), float) for name in names])


def data_array(rows: Rows, names: list[Any]) -> Any:
    return xarray.DataArray(rows, dims=("t", "joint"), coords={"t": [0.5 * k for k in range(len(rows))], "joint": names})


def of_objects(values: list[Any]) -> Any:
    made = np.empty(len(values), object)
    made[:] = values
    return made


# Containers with names of columns. Each holds the rows of a table, and its first element is a row.
LABELLED: dict[str, Callable[[Rows, list[Any]], Any]] = {
    "frame": frame,
    "frame with names of rows": lambda rows, names: frame(rows, names).set_axis([f"stop {k}" for k in range(len(rows))]),
    "series": lambda rows, names: [pandas.Series(row, index=names) for row in rows],
    "rows of a frame": lambda rows, names: tuple(row for _, row in frame(rows, names).iterrows()),
    "deque of series": lambda rows, names: deque(pandas.Series(row, index=names) for row in rows),
    "list of another class": lambda rows, names: UserList(pandas.Series(row, index=names) for row in rows),
    "hierarchy": lambda rows, names: pandas.DataFrame(rows, columns=pandas.MultiIndex.from_product([["arm"], names])),
    "categories": lambda rows, names: pandas.DataFrame(rows, columns=pandas.CategoricalIndex(names)),
    "namedtuples": tuples,
    "polars": lambda rows, names: polars.DataFrame(rows, schema=[str(name) for name in names], orient="row"),
    "arrow": lambda rows, names: pyarrow.table({str(name): [row[k] for row in rows] for k, name in enumerate(names)}),
    "xarray": data_array,
    "rows of xarray": lambda rows, names: list(data_array(rows, names)),
    "numbers of xarray": lambda rows, names: [[number for number in row] for row in data_array(rows, names)],
}
# Containers that are never configurations, even with the right names.
NO_ARRAYS: dict[str, Callable[[Rows, list[Any]], Any]] = {
    "structured": structured,
    "records": lambda rows, names: list(structured(rows, names)),
    "record array": lambda rows, names: structured(rows, names).view(np.recarray),
    "dicts": lambda rows, names: [dict(zip(names, row, strict=True)) for row in rows],
    "dict": lambda rows, names: frame(rows, names).to_dict("list"),
    "columns": lambda rows, names: [frame(rows, names)[name] for name in names],
    "columns of polars": lambda rows, names: list(LABELLED["polars"](rows, names)),
    "transposed": lambda rows, names: frame(rows, names).T,
    "transposed xarray": lambda rows, names: data_array(rows, names).T,
    "columns of xarray": lambda rows, names: list(data_array(rows, names).T),
    "tuple of columns": lambda rows, names: namedtuple("columns", names)(*zip(*rows, strict=True)) if all(str(n).isidentifier() for n in names) else {},
    "objects": lambda rows, names: of_objects(LABELLED["series"](rows, names)),
}


def shortened(kind: str) -> Any:
    values = READS[kind][0]
    if kind in ("path", "ranges"):
        return values[:2]
    return [rows[:2] for rows in values] if kind == "paths" else values


def labelled(make: Callable[[Rows, list[Any]], Any], values: Any, names: list[Any], order: list[int]) -> Any:
    """Returns a container of values of the given number of dimensions, with columns in another order."""
    plain = np.array(values, float)[..., order]
    if plain.ndim == 1:
        made = make([plain.tolist()], names)
        if isinstance(made, (pandas.DataFrame, polars.DataFrame, pyarrow.Table)):
            return made.iloc[0] if isinstance(made, pandas.DataFrame) and made.shape == (1, 2) else made
        return made[0] if len(made) == 1 else made
    return make(plain.tolist(), names) if plain.ndim == 2 else [make(rows.tolist(), names) for rows in plain]


@pytest.mark.parametrize("container", list(LABELLED | NO_ARRAYS))
@pytest.mark.parametrize("kind", KINDS)
def test_names_are_those_of_the_joints_or_refused(kind: str, container: str) -> None:
    make, read = (LABELLED | NO_ARRAYS)[container], READS[kind][1]
    values = shortened(kind)
    if container == "objects" and np.ndim(values) == 1:
        pytest.skip("one series")
    known = read(values)
    right, turned = [0, 1], [1, 0]
    swapped = JOINTS[::-1]
    wrong = [(swapped, turned)]
    wrong += [([rename.format(name) for name in JOINTS], right) for rename in ("{}_deg", "arm/{}", "to{}", "from_to_{}", " {}")]
    wrong += [(["X", "Y"], right), (["X", "Y"][::-1], turned), (["x", "z"], right), (["z", "y"], right), (["x", "x_deg"], right), (["1", "0"], right)]
    prefixes = {"edges from": "from_", "start": "from_", "edges to": "to_", "end": "to_"}
    for prefix in ("from_", "to_"):
        named = [prefix + name for name in JOINTS]
        wrong.append((named[::-1], turned))
        if prefixes.get(kind) != prefix:
            wrong.append((named, right))
    for names, order in wrong:
        given = labelled(make, values, names, order)
        with pytest.raises((InputError, TypeError)) as refused:
            read(given)
        if container in LABELLED and container not in ("rows of xarray", "numbers of xarray", "hierarchy"):
            text = str(refused.value)
            of_degrees = any(name.endswith("_deg") for name in names) and ("has no degrees" in text or "two columns" in text)
            assert of_degrees or f"labels are {', '.join(names)}, but the joints are x, y" in text, text
    for names in [JOINTS] + [[prefixes[kind] + name for name in JOINTS] for _ in [0] if kind in prefixes]:
        given = labelled(make, values, names, right)
        if container in NO_ARRAYS or container in ("numbers of xarray", "hierarchy"):
            with pytest.raises((InputError, TypeError)):
                read(given)
        else:
            assert read(given) == known, names


@pytest.mark.parametrize("kind", KINDS)
def test_default_labels_are_none(kind: str) -> None:
    values, read = shortened(kind), READS[kind][1]
    known = read(values)
    makes: list[Callable[[Rows, Any], Any]] = [
        lambda rows, _: pandas.DataFrame(rows),
        lambda rows, _: pandas.DataFrame(rows, index=pandas.date_range("2020-01-01", periods=len(rows))),
        lambda rows, _: polars.DataFrame(np.array(rows)),
        lambda rows, _: [pandas.Series(row) for row in rows],
        lambda rows, _: xarray.DataArray(rows),
        lambda rows, _: xarray.DataArray(rows, dims=("t", "joint"), coords={"t": np.arange(len(rows)) / 8}),
        lambda rows, _: deque(np.array(row) for row in rows),
        lambda rows, _: UserList(rows),
    ]
    for make in makes:
        if np.ndim(values) > 1:
            assert read(labelled(make, values, [], [0, 1])) == known
    row = np.array(PATH[1])
    for given in (pandas.Series(row), polars.Series(row), Own(row), xarray.DataArray(row)):
        assert repr(CELL.closest_approach(given)) == repr(CELL.closest_approach(PATH[1]))
        assert ROBOT.pose("b", given).tolist() == ROBOT.pose("b", PATH[1]).tolist()


def test_a_name_of_a_column_is_no_configuration() -> None:
    scalars = xarray.DataArray(PATH[:2], dims=("t", "joint"), coords={"joint": ["x", "y"]})
    column, named = frame(PATH[:2], JOINTS)["x"], polars.Series("x", [0.5, 1.5])
    for given in (column, named, scalars.sel(joint="x"), [scalars[0].sel(joint=name) for name in ("y", "x")]):
        with pytest.raises(InputError, match="the labels are .*, but the joints are x, y"):
            CELL.is_free(given)


def test_degrees_are_those_of_a_whole_frame() -> None:
    joints = [Joint.revolute("pan", "base", "a", axis=[0, 0, 1]), Joint.revolute("lift", "a", "b", axis=[0, 1, 0])]
    robot = Robot(joints, {"base": Body.sphere(0.1), "b": [(Body.sphere(0.1), ([1, 0, 0], [0, 0, 0, 1]))]})
    cell = Cell(robot)
    cell.add_obstacle("post", Body.sphere(0.1), ([0, 1, 0], [0, 0, 0, 1]))
    path = [[0.0, 0.0], [3.0, 0.1]]
    degrees = frame(np.rad2deg(path).tolist(), ["pan_deg", "lift_deg"])
    known, found = cell.first_contact(path), cell.first_contact(degrees)
    assert known is not None and found is not None and abs(found.time - known.time) < 1e-9
    refused: list[Any] = [[row for _, row in degrees.iterrows()], degrees[["lift_deg", "pan_deg"]], degrees.T]
    for given in refused:
        with pytest.raises(InputError, match="the labels are"):
            cell.is_free(given)
    questions: list[Callable[[], Any]] = [lambda: cell.answer_paths([degrees]), lambda: cell.answer_edges([degrees.iloc[0]], [degrees.iloc[1]])]
    for ask in questions:
        with pytest.raises(InputError, match="the labels are pan_deg, lift_deg"):
            ask()
    start, end = (degrees.iloc[[k]].add_prefix(prefix) for k, prefix in enumerate(("from_", "to_")))
    assert cell.answer_edges(start, end, "first-contact")["status"].tolist() == ["contact"]


def test_values_of_a_curve_are_labelled_too() -> None:
    class Spline(Polynomials):
        def __call__(self, times: Any, nu: int = 0) -> Any:
            return frame(np.zeros((len(times), 2)).tolist(), ["y", "x"])

    coefficients = np.zeros((2, 2, 2))
    for curve in (Spline(coefficients, [0, 1, 2]), [Spline(coefficients, [0, 1, 2])]):
        with pytest.raises(InputError, match="the labels are y, x"):
            CELL.answer_paths(curve) if isinstance(curve, list) else CELL.is_free(curve)


def test_many_labels_are_cut_short() -> None:
    many = pandas.DataFrame(np.zeros((2, 1000)), columns=[f"c{k}" for k in range(1000)])
    with pytest.raises(InputError) as refused:
        CELL.is_free(many)
    assert len(str(refused.value)) < 300


def test_rows_of_edges_have_the_same_order() -> None:
    start = pandas.DataFrame([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], columns=JOINTS)
    end = start + 0.5

    def statuses(start: Any, end: Any) -> Any:
        return CELL.answer_edges(start, end)["status"].tolist()

    expected = statuses(start.to_numpy(), end.to_numpy())
    assert statuses(start, end) == statuses(start, end.to_numpy()) == expected
    with pytest.raises(InputError, match="the same labels in different orders"):
        statuses(start, end.iloc[::-1])
    assert statuses(start, end.iloc[::-1].loc[start.index]) == expected
    assert statuses(start, end.set_index(pandas.Index(["a", "b", "c"]))) == expected
    assert len(statuses(start.iloc[:-1], start.iloc[1:])) == 2
