"""Arrays of any type, class and order in memory are read like nested lists of their elements, or are refused."""

import functools
import math
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from rigid_ccd import (
    Body,
    Cell,
    EdgesQuery,
    InputError,
    Joint,
    Motion,
    PosePath,
    Robot,
    Table,
    closest_approaches,
    first_contact,
    first_contacts,
)

# Multiples of 1/4, which all types of floats represent exactly.
CORNERS: Any = [[0, 0, 0], [1, 0, 0.25], [0, 1, 0.5], [0, 0, 1], [-1, -0.5, 0.25]]
FACES: Any = [[0, 1, 2], [0, 1, 3], [1, 2, 3], [0, 2, 4]]
TURN: Any = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
PATH: Any = [[0, 1], [1.5, -1], [0.25, 0.5], [-1, 2]]
BALL, WALL = Body.sphere(0.5), Body.box(0.1, 5, 5)


class Polynomials:
    """Polynomials with the attributes of scipy.interpolate.PPoly."""

    def __init__(self, c: Any, x: Any) -> None:
        self.c, self.x = c, x


class Own:
    """An object that converts itself to an array."""

    def __init__(self, values: Any) -> None:
        self.values = values

    def __array__(self, *args: Any, **how: Any) -> Any:
        return np.array(self.values, *args, **how)


class Sub(np.ndarray[Any, Any]):
    """An array of another class."""


def gantry() -> Robot:
    joints = [Joint.prismatic("x", "w", "a", axis=[1, 0, 0]), Joint.prismatic("y", "a", "b", axis=[0, 1, 0])]
    return Robot(joints, {"b": Body.sphere(0.1)})


def cell() -> Cell:
    made = Cell(gantry())
    made.add_obstacle("post", Body.box(0.1, 0.1, 5), ([0.75, 0, 0], [0, 0, 0, 1]))
    return made


CELL = cell()
ROBOT = CELL.robot


def table(found: Table) -> Any:
    return pickle.dumps({name: found[name].tolist() for name in found if name != "micros"})


def pose(rotation: Any) -> Any:
    return [[*row, k] for k, row in enumerate(rotation)] + [[0, 0, 0, 1]]


def axis_of(axis: Any) -> Any:
    return Robot([Joint.revolute("j", "a", "b", axis=axis)]).pose("b", [1.0]).tolist()


# All arguments read from arrays: each with a valid nested list, and a function that returns a text of the values read.
READS: dict[str, tuple[Any, Callable[[Any], Any]]] = {
    "path": (PATH, lambda a: repr((CELL.first_contact(a), CELL.closest_approach(a)))),
    "configuration": (PATH[1], lambda a: repr(CELL.closest_approach(a))),
    "ranges": (PATH, lambda a: repr(CELL.clearance_ranges(a, resolution=0.01))),
    "proofs": (PATH[2:], lambda a: [proof.proof for proof in CELL.prove(a)]),
    "edges from": (PATH, lambda a: table(CELL.answer_edges(a, PATH[::-1], "first-contact"))),
    "edges to": (PATH, lambda a: table(CELL.answer_edges(PATH[::-1], a, "first-contact"))),
    "paths": ([PATH, PATH[::-1]], lambda a: table(CELL.answer_paths(a, "closest-approach"))),
    "vertices": (CORNERS, lambda a: pickle.dumps(Body(a, FACES))),
    "faces": (FACES, lambda a: pickle.dumps(Body(CORNERS, a))),
    "size": ([1, 2, 0.25], lambda a: pickle.dumps(Body.box(size=a))),
    "position": ([1, 2, -3], lambda a: repr(Motion(a))),
    "quaternion": ([0.25, 0.5, -0.75, 0.5], lambda a: repr(Motion(rotation=a))),
    "matrix": (TURN, lambda a: repr(Motion(rotation=a))),
    "velocity": ([1, 2, -3], lambda a: repr(Motion(velocity=a))),
    "angular_velocity": ([1, 2, -3], lambda a: repr(Motion(angular_velocity=a))),
    "center": ([1, 2, -3], lambda a: Motion(angular_velocity=[1, 2, 3], center=a).pose(1).tolist()),
    "pose": (pose(TURN), lambda a: repr(Motion.still(a))),
    "pair": ([1, 2, -3], lambda a: repr(Motion.still((a, [0, 0, 0, 1])))),
    "times": ([0, 1, 2.5], lambda a: PosePath(a, [pose(TURN)] * 3).pose(0.5).tolist() + [PosePath(a, [pose(TURN)] * 3).end]),
    "poses": ([pose(np.eye(3)), pose(TURN)], lambda a: PosePath([0, 1], a).pose(0.25).tolist()),
    "angular_velocities": ([[0.25, 0.5, 0], [-0.25, 0, 0.5]], lambda a: PosePath([0, 1, 2], [np.eye(4)] * 3, angular_velocities=a).pose(1.5).tolist()),
    "axis": ([1, 2, -2], axis_of),
    "limits": ([-1, 2.5], lambda a: Joint.revolute("j", "a", "b", limits=a).limits),
    "place": ([0.5, 1.5], lambda a: ROBOT.pose("b", a).tolist()),
    "start": ([0.5, 1.5], lambda a: repr(ROBOT.link_trajectory("b", a, [1, 2]))),
    "end": ([0.5, 1.5], lambda a: repr(ROBOT.link_trajectory("b", [1, 2], a))),
    "coefficients": (
        [[[0.5, 1], [0.25, 0]], [[0, 1], [1, 3]], [[0, 0], [0.5, 2]]],
        lambda a: repr(CELL.closest_approach(Polynomials(a, [0, 1, 2]))),
    ),
    "breakpoints": (
        [0, 1, 2],
        lambda a: repr(CELL.closest_approach(Polynomials([[[0.5, 1], [0.25, 0]], [[0, 1], [0.5, 2]]], a))),
    ),
    "column": ([-3, 2, 1.5, 4], lambda a: table(first_contacts(BALL, WALL, {"a_px": a, "a_vx": [4] * 4}))),
    "column of ids": ([7, 2, 3, 9], lambda a: table(first_contacts(BALL, WALL, {"id": a, "a_px": [1] * 4}))),
    "column of a table": ([-3, 2, 1.5, 4], lambda a: table(Table({"x": a}))),
    "rows": ([3, 1, 1, 0], lambda a: table(Table({"x": [1, 2, 3, 4]}).take(a))),
    "joint": ([-3, 2, 1.5, 4], lambda a: table(EdgesQuery(CELL)({"id": range(4), "from_x": a, **dict.fromkeys(["to_x", "from_y", "to_y"], [1] * 4)}))),
}
# The arguments that are read as whole numbers only.
WHOLE = ("faces", "column of ids", "rows")


def draw(values: Any, kind: str, random: np.random.Generator) -> tuple[Any, str]:
    """Returns an array of values, and a description of how it was made."""
    plain = np.array(values)
    types = "i1 i2 i4 i8" if kind in WHOLE else "f2 f4 f8 f8 f8 g O i8"
    if (plain == np.abs(plain)).all() and kind != "axis":
        types += " u1 u8"
    dtype = str(random.choice(types.split()))
    if dtype[0] in "iu" and (plain != np.rint(plain)).any():
        dtype = "f8"
    if dtype not in ("g", "O", "i1", "u1"):
        dtype = str(random.choice(["<", ">"])) + dtype
    made = laid_out(plain.astype(dtype), random)
    if random.integers(2):
        made.setflags(write=False)
    return as_object(made, kind, random)[0], f"{kind}, {dtype}, strides {made.strides}, {made.flags}"


def laid_out(plain: Any, random: np.random.Generator) -> Any:
    """Returns an array with the same elements at other places in memory."""
    order = random.integers(6)
    if order == 0:
        return np.asfortranarray(plain)
    if order == 1:
        axes = random.permutation(plain.ndim)
        return np.ascontiguousarray(plain.transpose(axes)).transpose(np.argsort(axes))
    if order == 2 and plain.dtype != object:
        # Puts the elements at an odd address, from which a processor may not be able to read numbers.
        raw = bytearray(1) + plain.tobytes()
        return np.frombuffer(raw, np.uint8)[1:].view(plain.dtype).reshape(plain.shape) if plain.dtype.itemsize == 1 else np.ndarray(plain.shape, plain.dtype, raw, 1)
    # Uses every other element of a larger array, forwards or backwards.
    steps = [int(step) for step in random.choice([-3, -2, -1, 1, 2, 3], plain.ndim)]
    large = np.full([3 * n + 2 for n in plain.shape], 77).astype(plain.dtype)
    where = []
    for n, step in zip(plain.shape, steps, strict=True):
        first = int(random.integers(3)) if step > 0 else int(random.integers(3 * n - 1, 3 * n + 2))
        last = first + n * step
        where.append(slice(first, last if last >= 0 else None, step))
    view = large[tuple(where)]
    view[...] = plain
    return view


def as_object(made: Any, kind: str, random: np.random.Generator) -> tuple[Any, str]:
    """Returns the array as an object of another kind with the same elements."""
    pandas, polars = pytest.importorskip("pandas"), pytest.importorskip("polars")
    choices: list[Callable[[], Any]] = [lambda: made, lambda: made.view(Sub), lambda: Own(made)]
    choices += [lambda: np.ma.MaskedArray(made), lambda: list(made), lambda: tuple(made) if kind != "pose" else list(made)]
    native = made.dtype.newbyteorder("=")
    if made.dtype != "g" and made.ndim == 2 and kind != "poses":
        choices += [lambda: made.view(np.matrix), lambda: pandas.DataFrame(made.astype(native)), lambda: pandas.DataFrame(made.astype(native)[::-1])[::-1]]
        if made.dtype != object:
            choices.append(lambda: polars.DataFrame(np.array(made.astype(native))))
    if made.dtype != "g" and made.ndim == 1:
        choices += [lambda: pandas.Series(made.astype(native)), lambda: pandas.Series(made.astype(native)[::-1])[::-1]]
    return choices[int(random.integers(len(choices)))](), ""


@pytest.mark.parametrize("kind", list(READS))
def test_an_array_is_the_nested_list_of_its_elements(kind: str) -> None:
    values, read = READS[kind]
    known, random = read(values), np.random.default_rng(len(kind))
    read_count = 0
    for _ in range(60):
        given, how = draw(values, kind, random)
        try:
            found = read(given)
        except TypeError as error:
            # Poses and ids are read one by one.
            assert kind in ("poses", "column of ids") and "Own" in str(error), how
            continue
        except InputError as error:
            # A column refuses arrays of objects, so it refuses Fractions too.
            assert "object" in str(error) or "float128" in str(error) or "longdouble" in str(error), (how, error)
            continue
        assert found == known, how
        read_count += 1
    assert read_count >= 40


@pytest.mark.parametrize("kind", list(READS))
def test_what_is_no_number_is_refused(kind: str) -> None:
    values, read = READS[kind]
    plain = np.array(values)
    first = (0,) * plain.ndim

    def masked() -> Any:
        mask = np.zeros(plain.shape, bool)
        mask[first] = True
        return np.ma.MaskedArray(plain, mask)

    def with_object(value: Any) -> Any:
        objects = plain.astype(object)
        objects[first] = value
        return objects

    wrong: list[Callable[[], Any]] = [masked, lambda: list(masked()), lambda: [list(masked())] if plain.ndim == 1 else list(masked())]
    wrong += [functools.partial(with_object, value) for value in ("1", b"1", True, np.True_, None, 1j, "one")]
    wrong += [lambda: plain.astype(str), lambda: plain.astype("S8"), lambda: plain.astype(complex)]
    wrong += [lambda: plain.astype("i8").astype("M8[s]"), lambda: plain.astype("i8").astype("m8[s]")]
    wrong += [lambda: np.zeros(plain.shape, [("a", float)]), lambda: "0", lambda: {"a": 1}]
    if kind != "rows":
        wrong += [lambda: plain.astype(bool), lambda: plain.astype(bool).tolist()]
    ids = kind == "column of ids"
    for make in wrong:
        given = make()
        if ids and not isinstance(given, np.ma.MaskedArray):
            continue
        with pytest.raises((InputError, TypeError)):
            read(given)
    if kind not in WHOLE:
        nan = plain.astype(float)
        nan[first] = math.nan
        if "column" in kind or kind in ("joint", "edges from", "edges to", "paths"):
            return
        with pytest.raises(InputError):
            read(nan)


@pytest.mark.parametrize("kind", list(READS))
def test_what_has_another_shape_is_refused(kind: str) -> None:
    values, read = READS[kind]
    plain = np.array(values)
    shapes = [plain[..., :0], plain[..., :-1], plain[None], plain[:, None], plain.ravel()[0]]
    known = read(values)
    for given in shapes:
        try:
            found = read(given)
        except (InputError, TypeError):
            continue
        # Extra dimensions of one element, or fewer rows, are read as such or refused, but never read as another shape.
        assert given.size == 0 or found == known or given.shape[:-1] != plain.shape[:-1] or kind in FEWER, (given.shape, found)


# For these arguments a shorter list is valid too.
FEWER = ("column of a table", "rows", "column of ids")


def test_the_free_path_that_was_not() -> None:
    made = Cell(gantry())
    made.add_obstacle("post", Body.box(0.1, 0.1, 5), ([2, 0, 0], [0, 0, 0, 1]))
    q = np.array([[0, 4.0], [1, -1]]).T
    assert not q.flags.c_contiguous
    for given in (q, q.copy(order="C"), q.tolist()):
        assert not made.is_free(given)
        contact = made.first_contact(given)
        assert contact is not None and 0.44 < contact.fraction < 0.46


def test_columns_of_a_frame_are_joints() -> None:
    pandas = pytest.importorskip("pandas")
    polars = pytest.importorskip("polars")
    pyarrow = pytest.importorskip("pyarrow")
    good = {"x": [float(row[0]) for row in PATH], "y": [float(row[1]) for row in PATH]}
    bad = {"y": good["y"], "x": good["x"]}
    known = repr(CELL.first_contact(PATH))
    for make in (pandas.DataFrame, polars.DataFrame):
        assert repr(CELL.first_contact(make(good))) == known
        for use in (
            CELL.first_contact,
            CELL.is_free,
            CELL.prove,
            CELL.clearance_ranges,
            lambda frame: CELL.answer_edges(frame, PATH),
            lambda frame: CELL.answer_edges(PATH, frame),
        ):
            with pytest.raises(InputError, match="the labels are y, x, but the joints are x, y"):
                use(make(bad))
        with pytest.raises(InputError, match="the labels are a, b, but"):
            CELL.first_contact(make({"a": good["x"], "b": good["y"]}))
    assert repr(CELL.first_contact(pandas.DataFrame(bad)[CELL.robot.joint_names])) == known
    series = pandas.Series({"y": 1.0, "x": 0.0})
    for ask in (lambda: ROBOT.pose("b", series), lambda: CELL.is_free(series), lambda: ROBOT.link_trajectory("b", series, [0, 0])):
        with pytest.raises(InputError, match="joints"):
            ask()
    assert ROBOT.pose("b", series[["x", "y"]])[:2, 3].tolist() == [0, 1]
    with pytest.raises(InputError):
        CELL.is_free(pyarrow.table(bad))


def test_columns_of_arrow_are_read_from_their_offsets() -> None:
    pyarrow: Any = pytest.importorskip("pyarrow")
    random = np.random.default_rng(3)
    for _ in range(60):
        rows = int(random.integers(0, 9))
        values = random.integers(-8, 8, rows) / 4
        empty = random.integers(0, 2, rows).astype(bool) if random.integers(2) else np.zeros(rows, bool)
        kind = random.choice(["halffloat", "float32", "float64", "int8", "int64", "dictionary", "decimal"])
        if "int" in kind:
            values = np.rint(values)
        listed = [None if gone else float(value) for value, gone in zip(values, empty, strict=True)]
        before, after = random.integers(0, 20, 2).tolist()
        padded = [9.0] * before + listed + [None] * after
        if kind == "dictionary":
            whole = pyarrow.array(padded, pyarrow.float64()).dictionary_encode()
        elif kind == "decimal":
            whole = pyarrow.array(padded, pyarrow.float64()).cast(pyarrow.decimal128(8, 2))
        else:
            whole = pyarrow.array(padded, pyarrow.float64()).cast(kind)
        column = whole.slice(before, rows)
        if random.integers(2) and rows > 1:
            column = pyarrow.chunked_array([column.slice(0, 1), column.slice(1)])
        still = pyarrow.array([0.5] * rows)
        found = closest_approaches(BALL, WALL, pyarrow.table({"a_px": column, "a_py": still}), micros=False)
        assert len(found) == rows
        for row, value in enumerate(listed):
            if value is None:
                assert found["status"][row] == "error"
                continue
            single = closest_approaches(BALL, WALL, {"a_px": [value], "a_py": [0.5]}, micros=False)
            assert found["status"][row] == single["status"][0]
            assert np.array_equal(found["distance_upper"][row], single["distance_upper"][0], equal_nan=True)


def test_a_path_of_parquet_is_read(tmp_path: Any) -> None:
    pyarrow: Any = pytest.importorskip("pyarrow")
    parquet: Any = pytest.importorskip("pyarrow.parquet")
    random = np.random.default_rng(4)
    columns = {"a_px": random.integers(-20, 20, 500) / 4, "a_vx": random.integers(-8, 8, 500) / 4}
    known = table(first_contacts(BALL, WALL, {name: values.tolist() for name, values in columns.items()}))
    for type_ in ("float64", "float32", "halffloat"):
        for options in ({}, {"use_dictionary": True, "row_group_size": 7}, {"compression": "none", "data_page_size": 64}):
            arrow = pyarrow.table({name: pyarrow.array(values).cast(type_) for name, values in columns.items()})
            parquet.write_table(arrow, tmp_path / "t.parquet", **options)
            for read in (parquet.read_table(tmp_path / "t.parquet"), parquet.ParquetFile(tmp_path / "t.parquet", memory_map=True).read()):
                assert table(first_contacts(BALL, WALL, read)) == known


def test_a_mesh_of_trimesh_is_read_as_it_is() -> None:
    class Mesh:
        def __init__(self, vertices: Any, faces: Any) -> None:
            self.vertices, self.faces = vertices, faces

    known, random = pickle.dumps(Body(CORNERS, FACES)), np.random.default_rng(6)
    for _ in range(60):
        mesh: Any = Mesh(draw(CORNERS, "vertices", random)[0], draw(FACES, "faces", random)[0])
        try:
            assert pickle.dumps(Body.from_trimesh(mesh)) == known
        except InputError as error:
            assert "object" in str(error)
    assert first_contact(Body(CORNERS, FACES), BALL, Motion([5, 0, 0])) is None
