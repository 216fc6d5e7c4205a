"""Wrong arguments are refused with errors that name them: whole numbers, truth values, names and folders."""

import itertools
import pickle
from collections.abc import Callable
from pathlib import Path
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
    Proof,
    Robot,
    Table,
    TableQuery,
    closest_approach,
    distance,
    first_contact,
    first_contacts,
    prove,
)
from rigid_ccd import PosePath

BALL, WALL = Body.sphere(0.5), Body.box(0.1, 5, 5)


def slide() -> Cell:
    cell = Cell(Robot([Joint.prismatic("x", "rail", "cart", axis=[1, 0, 0])], {"cart": BALL}))
    cell.add_obstacle("wall", WALL, ([3, 0, 0], [0, 0, 0, 1]))
    return cell


CELL = slide()
EDGES: Any = ([[0.0]], [[1.0]])

# All arguments that are whole numbers, each with the numbers that it refuses.
WHOLE: dict[str, tuple[str, Callable[[Any], Any], list[Any]]] = {
    "threads of edges": ("threads", lambda n: CELL.answer_edges(*EDGES, threads=n), [0, -1, 1025, 2**70, -(2**70)]),
    "threads of paths": ("threads", lambda n: CELL.answer_paths([[[0.0]]], threads=n), [0, -1, 1025, 2**70]),
    "threads of tables": ("threads", lambda n: first_contacts(BALL, WALL, {"a_px": [1]}, threads=n), [0, -1, 1025, 2**70]),
    "threads of engines": ("threads", lambda n: TableQuery(BALL, WALL, threads=n), [0, -1, 2**70]),
    "threads of edges of engines": ("threads", lambda n: EdgesQuery(CELL, threads=n), [0, -1, 2**70]),
    "boxes": ("max_boxes", lambda n: CELL.robot.classify_link_contacts(n), [-1, 2**70, -(2**70)]),
    "budget": ("budget", lambda n: first_contact(BALL, WALL, budget=n), [-1, 2**64, 2**70]),
    "budget of a distance": ("budget", lambda n: distance(BALL, WALL, budget=n), [-1, 2**64]),
    "budget of a proof": ("budget", lambda n: prove(BALL, WALL, budget=n), [-1, 2**64]),
    "budget of a cell": ("budget", lambda n: CELL.is_free([[0.0]], budget=n), [-1, 2**64]),
    "budget of ranges": ("budget", lambda n: CELL.clearance_ranges([[0.0]], budget=n), [-1, 2**64]),
    "budget of tables": ("budget", lambda n: first_contacts(BALL, WALL, {"a_px": [1]}, budget=n), [-1, 2**64]),
    "part": ("part", lambda n: Body.from_file(__file__, part=n), [-1, 2**64]),
}


@pytest.mark.parametrize("case", list(WHOLE))
def test_a_whole_number_out_of_range_is_named(case: str) -> None:
    name, use, numbers = WHOLE[case]
    for number in numbers:
        with pytest.raises(ValueError, match=f"{name}: {number} is not from ") as caught:
            use(number)
        assert isinstance(caught.value, InputError)
    for wrong in (1.5, "1", True, [1], np.array([1, 2]), 1j, b"1", np.float64(1)):
        with pytest.raises(TypeError, match=name):
            use(1.5 if isinstance(wrong, str) and name == "part" else wrong)
    with pytest.raises(InputError, match=name):
        use(10**5000)


def test_whole_numbers_of_numpy_are_taken() -> None:
    numbers: list[Any] = [np.int8(3), np.uint64(3), np.array(3)]
    for number in numbers:
        assert len(CELL.answer_edges(*EDGES, threads=number)) == 1
        assert not CELL.is_free([[3.0]], budget=number)


NUMBERS: dict[str, Callable[[Any], Any]] = {
    "radius": Body.sphere,
    "half_height": lambda x: Body.capsule(1, x),
    "excess": lambda x: Body.cylinder(1, 1, x),
    "x": lambda x: Body.box(x, 1, 1),
    "scale": lambda x: Body.from_file("part.obj", scale=x),
    "duration": lambda x: first_contact(BALL, WALL, duration=x),
    "tolerance": lambda x: first_contact(BALL, WALL, tolerance=x),
    "margin": lambda x: CELL.is_free([[0.0]], margin=x),
    "clearance": lambda x: CELL.closest_approach([[0.0]], clearance=x),
    "deadline": lambda x: CELL.is_free([[0.0]], deadline=x),
    "distance": lambda x: CELL.set_padding("cart", x),
    "resolution": lambda x: CELL.clearance_ranges([[0.0], [1.0]], resolution=x),
    "max_pose_error": lambda x: CELL.clearance_ranges([[0.0], [1.0]], max_pose_error=x),
}


@pytest.mark.parametrize("name", list(NUMBERS))
def test_what_is_no_number_is_named(name: str) -> None:
    for wrong in (True, np.True_, "1", [1.0], 1j, b"1", {}, object()):
        with pytest.raises(TypeError, match=name):
            NUMBERS[name](wrong)
    for wrong in (float("nan"), -1.0, float("-inf")) if name != "scale" else ():
        with pytest.raises(InputError):
            NUMBERS[name](wrong)
        assert repr(CELL.closest_approach([[0.0]])) == repr(slide().closest_approach([[0.0]]))


def test_a_clearance_of_a_path_is_compared() -> None:
    for clearance, verdict in ((0.25, "kept"), (1.5, "violated"), (None, None), (1.4, "unverified")):
        # The ball stays 1.4 from the wall.
        found = CELL.closest_approach([[0.0], [1.0]], clearance=clearance, tolerance=1e-3)
        assert found.clearance == verdict
    late = CELL.closest_approach([[0.0], [1.0]], clearance=1.39999, deadline=0)
    assert late.clearance == "unverified" and late.limit is not None
    assert closest_approach(BALL, WALL, Motion([3, 0, 0]), clearance=2).clearance == "kept"
    again = pickle.loads(pickle.dumps(late))
    assert again == late


def test_folders_and_names_are_one_or_a_list(tmp_path: Path) -> None:
    (tmp_path / "arm" / "meshes").mkdir(parents=True)
    (tmp_path / "arm" / "meshes" / "corner.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    text = (
        '<robot name="arm"><link name="a"><collision><geometry><mesh filename="package://arm/meshes/corner.obj"/>'
        "</geometry></collision></link></robot>"
    )
    with pytest.raises(InputError, match="corner.obj"):
        Robot.from_urdf_text(text)
    for packages in (str(tmp_path), tmp_path, [tmp_path], (str(tmp_path),), iter([tmp_path])):
        robot = Robot.from_urdf_text(text, packages=packages)
        assert pickle.loads(pickle.dumps(robot)).link_names == ["a"]
    wrong: Any
    for wrong in (3, [3], {"a": 1}.items(), b"/"):
        with pytest.raises((TypeError, InputError), match="packages|corner.obj"):
            Robot.from_urdf_text(text, packages=wrong)
    cell = slide()
    for wrong in ("rail", 3, [3], b"rail"):
        with pytest.raises(TypeError, match="may_touch"):
            cell.attach("tool", BALL, "cart", may_touch=wrong)
    assert "tool" not in repr(cell)


def test_iterators_without_an_end() -> None:
    with pytest.raises(InputError, match="poses: there are at least 3, but 2 times"):
        PosePath([0, 1], itertools.repeat(np.eye(4)))


def test_times_of_poses_are_times() -> None:
    moves = Motion([1, 2, 3], velocity=[1, 0, 0])
    for time in (float("nan"), float("inf"), float("-inf")):
        with pytest.raises(InputError, match="time"):
            moves.pose(time)


def test_a_proof_is_saved_under_the_name_of_a_file(tmp_path: Path) -> None:
    proof = prove(BALL, WALL, Motion([-3, 0, 0], velocity=[4, 0, 0]))
    assert isinstance(proof, Proof)
    for name in ("a/b", "../b", "/tmp/b", "", "."):
        with pytest.raises(InputError, match="name"):
            proof.save(tmp_path / "proofs", name)
    assert not (tmp_path / "proofs").exists()
    proof.save(tmp_path / "proofs", "a b")
    assert len(list((tmp_path / "proofs").iterdir())) == 5


def test_edges_of_tables_are_numbers_of_known_columns() -> None:
    query = EdgesQuery(CELL)
    good: dict[str, Any] = {"id": ["a"], "from_x": [0.0], "to_x": [1.0]}
    assert query(good)["status"].tolist() == ["free"]
    for wrong, message in (
        ({"to_y": [1.0]}, "unknown column to_y"),
        ({"weight": [1.0]}, "unknown column weight"),
        ({"from_x": ["0.5"]}, "numbers are needed"),
        ({"from_x": [True]}, "numbers are needed"),
    ):
        with pytest.raises(InputError, match=message):
            query({**good, **wrong})
    for rest in ("1", True, b"1"):
        with pytest.raises(InputError, match="rest"):
            EdgesQuery(CELL, rest={"x": rest})  # type: ignore[dict-item]
    pyarrow: Any = pytest.importorskip("pyarrow")
    for column in (pyarrow.array(["0.5"]), pyarrow.array([True])):
        with pytest.raises(InputError, match="numbers are needed"):
            query(pyarrow.table({**good, "from_x": column}))
    assert query(pyarrow.table({**good, "from_x": pyarrow.array([None], pyarrow.int64())}))["status"].to_pylist() == ["error"]
    assert isinstance(Table(good), Table)
