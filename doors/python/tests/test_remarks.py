"""Valid input that is probably a mistake gives a warning; usual input does not."""

import copy
import math
import pathlib
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from rigid_ccd import (
    Body,
    Cell,
    Joint,
    Motion,
    PosePath,
    Robot,
    closest_approach,
    distance,
    first_contact,
    first_contacts,
    is_free,
)

BALL, WALL = Body.sphere(0.5), Body.box(0.1, 5, 5)
PART = Body.sphere(0.0005)
CORNERS: Any = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
COLLADA = """<COLLADA version="1.4.1"><asset>{unit}</asset><library_geometries><geometry><mesh><source id="s">
<float_array id="a">0 0 0 1 0 0 0 1 0 0 0 1</float_array><technique_common><accessor source="#a" count="4" stride="3"/>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles count="4">
<input semantic="VERTEX" source="#v"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>
</COLLADA>"""


@pytest.mark.parametrize(
    ("words", "ask"),
    [
        ("the tolerance is large", lambda: first_contact(PART, WALL)),
        ("the tolerance is large", lambda: is_free(WALL, PART)),
        ("the tolerance is large", lambda: distance(PART, WALL)),
        ("the tolerance is large", lambda: first_contacts(PART, WALL, {"a_px": [1.0]})),
        ("the tolerance is large", lambda: closest_approach(BALL, WALL, tolerance=0.11)),
        ("makes many turns", lambda: first_contact(BALL, WALL, Motion([3, 0, 0], angular_velocity=[0, 0, 90]))),
        ("makes many turns", lambda: first_contacts(BALL, WALL, {"a_px": [3.0], "a_wz": [-360.0]})),
        ("far from unit length", lambda: Motion([0, 0, 0], [1, 1, 0, 0])),
        ("far from unit length", lambda: Motion.still(([0, 0, 0], [1e-200, 0, 0, 0]))),
        ("far from unit length", lambda: first_contacts(BALL, WALL, quaternions(2.0))),
        ("far from unit length", lambda: first_contacts(BALL, WALL, {"t": [0.0, 1.0], **quaternions(2.0)})),
        ("a joint's position", lambda: arm().link_trajectory("upper", [0, 0], [90, 0])),
        ("a mesh is not closed: it is a surface", lambda: Body(CORNERS, FACES[1:])),
        ("not closed, by no more than rounding", lambda: Body([*CORNERS, [-1e-16, 0, 0]], [[4, 2, 1], *FACES[1:]])),
        ("all vertices of a mesh are at one point", lambda: Body(np.zeros((12, 3)), np.arange(12).reshape(4, 3))),
    ],
)
def test_traps_are_warned_of_once(words: str, ask: Any) -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        ask()
    texts = [str(one.message) for one in told]
    assert len(texts) == 1 and words in texts[0], texts
    assert told[0].filename == __file__ and told[0].category is UserWarning


def test_a_file_in_another_unit_is_warned_of(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "part.dae"
    path.write_text(COLLADA.format(unit='<unit meter="0.001"/>'))
    with pytest.warns(UserWarning, match="a unit that is not the metre, and its numbers are kept") as told:
        kept = Body.from_file(path)
    assert len(told) == 1 and told[0].filename == __file__
    assert distance(kept, PART, None, ([0, 0, 3], [0, 0, 0, 1])).upper > 1.9
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        converted = Body.from_file(path, unit="m")
        assert distance(converted, PART, None, ([0, 0, 3], [0, 0, 0, 1]), tolerance=1e-6).lower > 2.99
        Body.from_file(path, scale=0.001)
        Body.from_file(path, file_unit="mm")
        path.write_text(COLLADA.format(unit=""))
        Body.from_file(path)


def test_what_is_usual_is_not() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for spin in (0, 1, 10, math.pi, 100, 20 * math.pi, 104.72):
            first_contact(BALL, WALL, Motion([3, 0, 0], angular_velocity=[0, 0, spin]))
        # Some of these numbers may be degrees, but not all of them.
        speeds = np.linspace(0, 180, 25)
        first_contacts(BALL, WALL, {"a_px": np.full(25, 3.0), "a_wz": speeds})
        first_contacts(BALL, WALL, {"a_px": [3.0, 3.0], **quaternions(1.01)})
        first_contact(Body.sphere(0.01), WALL)
        first_contact(Body.sphere(0), WALL, Motion([3, 0, 0]))
        first_contact(Body.box(1, 1, 1e-6), WALL, Motion([3, 0, 0]))
        arm().link_trajectory("upper", [0, 0], [2 * math.pi, 90])
        PosePath([0, 1], np.tile(np.eye(4), (2, 1, 1)))
        Body(CORNERS, FACES)
        # Flat meshes and declared surfaces give no warning, because they have no inside.
        Body(CORNERS, FACES[:1])
        Body(CORNERS, FACES[1:], surface=True)
        Body(CORNERS, FACES[1:], pieces="outer-hull")


def test_a_warning_may_be_an_error() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning, match="turns"):
            first_contact(BALL, WALL, Motion([3, 0, 0], angular_velocity=[0, 0, 90]))


def test_a_loop_is_warned_of_once() -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("default")
        for length in (2.0, 3.0, 4.0):
            Motion([0, 0, 0], [length, 0, 0, 0])
    assert len(told) == 1


def quaternions(length: float) -> dict[str, list[float]]:
    return {"a_qw": [length] * 2, "a_qx": [0.0] * 2, "a_qy": [0.0] * 2, "a_qz": [0.0] * 2}


def arm() -> Robot:
    """Returns a revolute and a prismatic joint."""
    hinge = Joint.revolute("hinge", "base", "upper")
    return Robot([hinge, Joint.prismatic("slide", "upper", "fore", axis=[1, 0, 0])])


URDF = """<robot name="arm"><link name="base"/>
  <link name="upper"><collision><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint></robot>"""
SRDF = '<robot name="arm"><disable_collisions link1="base" link2="upper" reason="Adjacent"/></robot>'
MJCF = """<mujoco model="arm"><worldbody><geom type="plane" size="1 1 1"/><body name="a" pos="0 0 1"><joint/><geom size="0.1"/>
  <body name="b" pos="1 0 0"><joint/><geom size="0.1"/></body></body></worldbody></mujoco>"""


def told(act: Callable[[], object]) -> list[str]:
    """Returns the texts of all warnings, and checks that they refer to lines of this file."""
    with warnings.catch_warnings(record=True) as all_of_them:
        warnings.simplefilter("always")
        act()
    for one in all_of_them:
        assert one.filename == __file__ and one.category is UserWarning
    return [str(one.message) for one in all_of_them]


def table(unit: float) -> Body:
    """Returns a table of 1.2 m as a mesh."""
    corners = np.array([[x, y, z] for x in (0, 1.2) for y in (0, 0.8) for z in (0, 0.75)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    return Body(corners * unit, faces)


def two_links(size: float = 0.4, **limits: Any) -> Robot:
    """Returns an arm with links of a given size, at twice that distance from each other."""
    at = ([0, 0, 2 * size], [0, 0, 0, 1])
    rod = Body.box(0.1 * size, 0.1 * size, size)
    joints = [Joint.revolute("hinge", "base", "upper", at, [0, 1, 0], **limits), Joint.revolute("elbow", "upper", "fore", at, [0, 1, 0])]
    return Robot(joints, {name: rod for name in ("base", "upper", "fore")})


def test_a_mesh_in_millimetres_is_warned_of() -> None:
    cell, far = Cell(two_links()), ([5000, 0, 0], [0, 0, 0, 1])
    [text] = told(lambda: cell.add_obstacle("table", table(1000), far))
    assert "is it in the robot's unit of length? table is 1200 long, and the robot 2.4" in text
    [held] = told(lambda: cell.attach("tool", table(1000), "fore", far))
    assert "tool is 1200 long" in held
    assert cell.remarks[:2] == [held, text]
    for part in ("sizes: robot 2.4, tool 1200, table 1200", text):
        assert part in repr(cell)
    # Copies have the remarks, and do not repeat the warnings.
    assert told(lambda: copy.copy(cell)) == []
    # In metres there is no warning.
    cell.remove_obstacle("table")
    cell.detach("tool")
    assert told(lambda: cell.add_obstacle("table", table(1), far)) == []
    # A warning raised as an error leaves the cell unchanged.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning, match="dust is 0.0002"):
            cell.add_obstacle("dust", Body.sphere(0.0001))
    assert "dust" not in repr(cell)


def test_a_robot_with_meshes_in_millimetres_is_warned_of() -> None:
    at = ([0, 0, 0.4], [0, 0, 0, 1])
    robot = Robot([Joint.revolute("hinge", "base", "upper", at), Joint.revolute("elbow", "upper", "fore", at)], {"upper": table(1000)})
    assert "upper is 1200 long, and the robot 0.8" in robot.remarks[0] and "size 1200" in repr(robot)
    [text] = told(lambda: Cell(robot))
    assert text == robot.remarks[0]


PATH: Any = [[0.0, 0.0], [0.1, 0.0]]
QUESTIONS: dict[str, Callable[..., object]] = {
    "is_free": lambda cell, path, **how: cell.is_free(path, **how),
    "first_contact": lambda cell, path, **how: cell.first_contact(path, **how),
    "closest_approach": lambda cell, path, **how: cell.closest_approach(path, **how),
    "clearance_ranges": lambda cell, path, **how: cell.clearance_ranges(path, **how),
    "prove": lambda cell, path, **how: cell.prove(path, **how),
    "edges": lambda cell, path, **how: cell.answer_edges(path[:1], path[1:], **how),
    "paths": lambda cell, path, **how: cell.answer_paths([path], **how),
}


@pytest.mark.parametrize("name", QUESTIONS)
def test_tolerances_and_degrees_of_questions_are_warned_of(name: str) -> None:
    ask, cell = QUESTIONS[name], Cell(two_links())
    cell.add_obstacle("table", table(1), ([5, 0, 0], [0, 0, 0, 1]))
    assert told(lambda: ask(cell, PATH)) == []
    [text] = told(lambda: ask(cell, PATH, tolerance=1.0))
    assert text.startswith("base: the tolerance is large against the smaller body")
    [text] = told(lambda: ask(cell, [[0.0, 0.0], [0.0, 90.0]]))
    assert text.startswith("joint elbow: a joint's position is a round number of degrees")


def test_files_with_mistakes_are_warned_of_once(tmp_path: pathlib.Path) -> None:
    def srdf(text: str) -> str:
        (tmp_path / "arm.srdf").write_text(text)
        return str(tmp_path / "arm.srdf")

    def mjcf(text: str) -> Robot:
        (tmp_path / "arm.xml").write_text(text)
        return Robot.from_mjcf(tmp_path / "arm.xml")

    of_other = SRDF.replace('name="arm"', 'name="leg"')
    with_tail = SRDF.replace("</robot>", '<disable_collisions link1="upper" link2="tail"/></robot>')
    weld = '<equality><weld body1="b"/></equality></mujoco>'
    readers: list[tuple[Callable[[], Robot], str]] = [
        (lambda: Robot.from_urdf_text(URDF, srdf=srdf(of_other)), "It is of `leg`, and the robot is `arm`"),
        (lambda: Robot.from_urdf_text(URDF, srdf=srdf(with_tail)), "the SRDF names links that the robot does not have; their pairs are left out: tail"),
        (lambda: Robot.from_urdf_text(URDF.replace("<axis", '<origin rpy="0 0 90"/><axis')), "joint hinge: roll, pitch or yaw is more than a turn"),
        (lambda: Robot.from_urdf_text('<robot name="a"><link name="base"/></robot>'), "one link without shapes, base"),
        (lambda: mjcf(MJCF.replace("</mujoco>", weld)), "in equality"),
        (lambda: mjcf("<mujoco><worldbody/></mujoco>"), "one link without shapes, world"),
    ]
    for read, words in readers:
        robots: list[Robot] = []
        [text] = told(lambda: robots.append(read()))
        assert words in text
        [robot] = robots
        assert text in "".join(robot.remarks) or words in robot.remarks[0]
        assert words in repr(robot)
        cells: list[Cell] = []
        assert told(lambda: cells.append(Cell(robot))) == []
        assert words in cells[0].remarks[0]
    right = srdf(SRDF)
    assert told(lambda: Robot.from_urdf_text(URDF, srdf=right)) == told(lambda: mjcf(MJCF)) == []


def usual_cells(tmp_path: pathlib.Path) -> dict[str, Callable[[], object]]:
    """Returns functions that make cells of usual kinds and ask questions about them."""
    slide = Joint.prismatic("x", "rail", "cart", axis=[1, 0, 0])
    ball, far = Body.sphere(0.1), ([4, 0, 0.5], [0, 0, 0, 1])

    def asked(robot: Robot, body: Body, at: Any = far, **how: Any) -> None:
        cell = Cell(robot)
        cell.add_obstacle("thing", body, at)
        path = np.zeros((2, len(robot.joint_names)))
        cell.is_free(path, **how)
        cell.closest_approach(path, tolerance=how.get("tolerance", 1e-4))
        cell.answer_edges(path[:1], path[1:])

    def read(text: str, name: str) -> Robot:
        (tmp_path / name).write_text(text)
        reader = Robot.from_mjcf if name.endswith("xml") else Robot.from_urdf
        return reader(tmp_path / name)

    def with_srdf() -> Robot:
        (tmp_path / "arm.srdf").write_text(SRDF)
        return Robot.from_urdf_text(URDF, srdf=tmp_path / "arm.srdf")

    def held() -> None:
        cell = Cell(Robot([Joint.prismatic("lift", "rail", "fork")]))
        cell.add_obstacle("table", Body.box(1, 1, 0.1), ([0, 0, -0.1], [0, 0, 0, 1]))
        cell.attach("can", Body.cylinder(0.033, 0.06), "fork", ([0, 0, 0.06], [0, 0, 0, 1]))
        cell.is_free([[0.0], [0.5]], start="leave")

    def on_plane() -> None:
        cell = Cell(two_links())
        cell.add_plane("floor", ([0, 0, -2], [0, 0, 0, 1]))
        cell.first_contact(PATH)

    drone = Robot.combined({"drone": Robot([], {"body": Body.box(0.2, 0.2, 0.05)})}, bases={"drone": "floating"})
    cart = Robot.combined({"cart": Robot([slide], {"cart": ball})}, bases={"cart": "planar"})
    gripper = Robot([Joint.prismatic("grip", "palm", "finger", axis=[1, 0, 0], limits=[0, 0.04])], {"finger": Body.box(0.01, 0.01, 0.03)})
    point = Robot(
        [Joint.prismatic("x", "w", "a", axis=[1, 0, 0], limits=[0, 10]), Joint.prismatic("y", "a", "b", axis=[0, 1, 0], limits=[0, 10])],
        {"b": Body.sphere(0.02)},
    )
    return {
        "an arm at a table": lambda: asked(two_links(), table(1)),
        "an arm and a screw": lambda: asked(two_links(), Body.capsule(0.003, 0.008)),
        "an arm on a floor of 400 m": lambda: asked(two_links(), Body.box(200, 200, 0.1), ([0, 0, -3], [0, 0, 0, 1])),
        "an arm in a hall": lambda: asked(two_links(), Body.box(30, 20, 4), ([60, 0, 0], [0, 0, 0, 1])),
        "an arm in millimetres": lambda: asked(two_links(400), table(1000), ([5000, 0, 0], [0, 0, 0, 1]), tolerance=1.0),
        "a slide before a wall": lambda: asked(Robot([slide], {"cart": ball}), Body.box(0.1, 5, 5)),
        "a drone in a building": lambda: asked(drone, Body.box(60, 40, 10), ([99, 0, 0], [0, 0, 0, 1])),
        "a cart in a street": lambda: asked(cart, Body.box(80, 10, 15), ([0, 50, 0], [0, 0, 0, 1])),
        "a gripper and a can": lambda: asked(gripper, Body.cylinder(0.033, 0.06)),
        "a point in a maze": lambda: asked(point, Body.box(5, 0.1, 0.5), ([5, 5, 0], [0, 0, 0, 1])),
        "a point cloud": lambda: asked(two_links(), Body.sphere(0)),
        "a file with an SRDF": lambda: asked(with_srdf(), table(1)),
        "a model of MuJoCo": lambda: asked(read(MJCF, "arm.xml"), table(1)),
        "a can that is lifted": held,
        "an arm above a plane": on_plane,
        "two arms": lambda: asked(Robot.combined({"left": two_links(), "right": two_links()}, {"right": far}), table(1), ([0, 5, 0], [0, 0, 0, 1])),
        "a hinge of a few turns": lambda: Cell(two_links(limits=[-7, 7])).is_free([[6.28, 0.0], [-6.28, 12.0]]),
    }


def test_usual_cells_have_no_warnings(tmp_path: pathlib.Path) -> None:
    for kind, ask in usual_cells(tmp_path).items():
        assert told(ask) == [], kind
