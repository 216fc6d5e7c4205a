"""Robots from joints, and paths, against closed forms and sampled poses."""

import copy
import math
import pickle
from typing import Any

import numpy as np
import pytest

from rigid_ccd import (
    Body,
    Cell,
    InputError,
    Joint,
    Motion,
    PosePath,
    Robot,
    closest_approach,
    distance,
    first_contact,
    is_free,
)

HERE: Any = ([0, 0, 0], [0, 0, 0, 1])
BALL = Body.sphere(0.1)


def arm() -> Robot:
    """Two links of length 1 and 2 in the plane; the third link is the tip."""
    hinge = Joint.revolute("hinge", "base", "upper", limits=(-4, 4))
    elbow = Joint.revolute("elbow", "upper", "fore", ([1, 0, 0], [0, 0, 0, 1]), [0, 0, 2])
    return Robot([hinge, elbow, Joint.fixed("wrist", "fore", "tip", ([2, 0, 0], [0, 0, 0, 1]))])


def tip(shoulder: float, elbow: float) -> list[float]:
    angle = shoulder + elbow
    return [math.cos(shoulder) + 2 * math.cos(angle), math.sin(shoulder) + 2 * math.sin(angle), 0]


def test_links_are_where_trigonometry_says() -> None:
    chain = arm()
    assert chain.joint_names == ["hinge", "elbow"]
    assert chain.pose("tip", [0.3, -1.1])[:3, 3] == pytest.approx(tip(0.3, -1.1))
    moves = chain.link_trajectory("tip", [0, 0], [1, -2], duration=2)
    for time in (0, 0.7, 2):
        assert moves.pose(time)[:3, 3] == pytest.approx(tip(time / 2, -time))
    # In the frame of the forearm, the tip is static.
    rests = chain.link_trajectory("tip", [0, 0], [1, -2], 2, seen_from="fore")
    assert rests.pose(0.7) == pytest.approx(rests.pose(0))


def test_the_tip_of_an_arm_touches_a_post() -> None:
    chain = arm()
    post = Body.sphere(0.05)
    for angle in np.linspace(0.2, 1.4, 7):
        # Both joints turn. The tip meets a post on its curve, and not the post beside it.
        begin, end = [0.0, 0], [1.5, 1.5]
        moves = chain.link_trajectory("tip", begin, end)
        place = tip(angle, angle)
        hit = first_contact(BALL, post, moves, Motion(place), tolerance=1e-6)
        assert hit is not None and hit.time < angle / 1.5
        assert np.linalg.norm(np.subtract(tip(1.5 * hit.time, 1.5 * hit.time), place)) == pytest.approx(0.15, abs=2e-6)
        assert not is_free(BALL, post, moves, Motion(place))
        beside = [*place[:2], 0.2]
        assert is_free(BALL, post, moves, Motion(beside))
        nearest = closest_approach(BALL, post, moves, Motion(beside), tolerance=1e-6)
        sampled = min(
            np.linalg.norm(np.subtract(tip(1.5 * t, 1.5 * t), beside)) - 0.15 for t in np.linspace(0, 1, 10_001)
        )
        assert nearest.lower <= sampled and sampled - 1e-5 <= nearest.upper


def test_links_see_each_other() -> None:
    chain = arm()
    # The tip folds back onto the shoulder: 3 away when stretched, 1 when folded.
    folds = chain.link_trajectory("tip", [0, 0], [0, math.pi], seen_from="base")
    assert first_contact(BALL, Body.sphere(0.8), folds) is None
    hit = first_contact(BALL, Body.sphere(1), folds)
    assert hit is not None and 0.5 < hit.time < 1


def test_positions_are_checked() -> None:
    chain = arm()
    for link, positions in (("toe", [0, 0]), ("upper", [0]), ("upper", [5, 0]), ("upper", [math.nan, 0])):
        with pytest.raises(InputError):
            chain.link_trajectory(link, positions, positions)
    with pytest.raises(InputError):
        chain.link_trajectory("tip", [0, 0], [0, 0], duration=0)
    with pytest.raises(InputError, match="there is no link `toe`"):
        chain.link_trajectory("upper", [0, 0], [1, 0], seen_from="toe")
    for limits in ((1, 0), (math.inf, math.inf), (math.nan, 1)):
        with pytest.raises(InputError, match="limits: no position is between"):
            Joint.revolute("hinge", "base", "upper", limits=limits)
    with pytest.raises(InputError):
        Joint.prismatic("slide", "base", "upper", axis=[0, 0, 0])
    with pytest.raises(TypeError):
        Robot([HERE])
    with pytest.raises(InputError, match="start: joint `hinge`: the joint is at 5, but its limits are -4 and 4"):
        chain.link_trajectory("upper", [5, 0], [0, 0])
    assert Joint.prismatic("slide", "base", "upper", limits=(0, 1)).limits == (0, 1)


def test_a_robot_is_made_of_joints_and_bodies() -> None:
    fingers = [
        Joint.prismatic("left", "hand", "left finger", ([0, 0.5, 0], [0, 0, 0, 1]), [0, 1, 0], (-0.4, 0)),
        Joint.prismatic("right", "hand", "right finger", ([0, -0.5, 0], [0, 0, 0, 1]), [0, -1, 0], mimic=("left", 1, 0)),
    ]
    tips: Any = {"left finger": BALL, "right finger": [(BALL, HERE), (BALL, ([1, 0, 0], [0, 0, 0, 1]))]}
    gripper = Robot(fingers, tips)
    assert gripper.joint_names == ["left"] and gripper.checked_pairs == [("left finger", "right finger")]
    assert Cell(gripper).closest_approach([[0.0], [-0.3]], tolerance=1e-8).upper == pytest.approx(0.2)
    assert not Cell(gripper).is_free([[0.0], [-0.4]])
    with pytest.raises(InputError, match="nothing is compared in this cell: .*1 not \\(disabled: may touch\\)"):
        Cell(Robot(fingers, tips, [("right finger", "left finger")])).is_free([[0.0], [-0.4]])
    # In the frame of the left finger, the right one approaches at twice the rate.
    comes = gripper.link_trajectory("right finger", [0.0], [-0.4], seen_from="left finger")
    hit = first_contact(BALL, BALL, comes)
    assert hit is not None and hit.time == pytest.approx(1, abs=1e-3)
    wrong: Any
    for wrong in ({"left finger": 3}, {"left finger": [BALL]}, {3: BALL}):
        with pytest.raises((TypeError, ValueError)):
            Robot(fingers, wrong)
    with pytest.raises(InputError, match="two joints are named `left`"):
        Robot([fingers[0], fingers[0]])
    with pytest.raises(InputError, match="no link `thumb`"):
        Robot(fingers, tips, [("thumb", "hand")])


def test_a_robot_is_copied_as_it_was_made() -> None:
    pose = np.eye(4)
    bodies: Any = {"lid": [(BALL, pose)]}
    robot = Robot([Joint.revolute("hinge", "frame", "lid")], bodies)
    pose[0, 3], bodies["knob"] = 1, 3
    again = pickle.loads(pickle.dumps(robot))
    assert again.link_names == ["frame", "lid"]
    for one in (robot, again):
        cell = Cell(one)
        cell.add_obstacle("post", BALL, ([1, 0, 0], [0, 0, 0, 1]))
        assert cell.is_free([[0.0]])


def test_mimic_joints_are_rounded_once() -> None:
    drive = Joint.prismatic("drive", "base", "driver")
    for multiplier, offset in ((math.nan, 0.0), (1.0, math.inf)):
        mimic = Joint.prismatic("follower", "base", "ball", axis=[1, 0, 0], mimic=("drive", multiplier, offset))
        with pytest.raises(InputError, match="joint `follower`: the multiplier or the offset is NaN or infinite"):
            Robot([drive, mimic])
    # Coordinates of a million cancel: in exact arithmetic the balls overlap by 5e-11.
    mimic = Joint.prismatic("follower", "base", "ball", axis=[1, 0, 0], mimic=("drive", 1000000.1, -1e6))
    cell = Cell(Robot([drive, mimic], {"ball": Body.sphere(0.5)}))
    cell.add_obstacle("wall", Body.sphere(0.5), ([1.1000000108069037, 0, 0], [0, 0, 0, 1]))
    assert not cell.is_free([[1.0000000000000109]], tolerance=1e-13)


def test_a_stop_limits_a_hinge() -> None:
    hinge = Joint.revolute("hinge", "frame", "lid")
    cell = Cell(Robot([hinge], {"lid": [(BALL, ([1, 0, 0], [0, 0, 0, 1]))]}))
    cell.add_obstacle("stop", BALL, ([math.cos(2), math.sin(2), 0], [0, 0, 0, 1]))
    kept, _, violated, _, again = cell.clearance_ranges([[0], [3]], margin=0.01)
    assert (kept.clearance, violated.clearance, again.clearance) == ("kept", "violated", "kept")
    half = 2 * math.asin(0.5 * 0.21)
    borders = [kept.end, violated.start, violated.end, again.start]
    assert np.multiply(3, borders) == pytest.approx([2 - half] * 2 + [2 + half] * 2, abs=2e-3)
    assert 3 * kept.end < 2 - half < 3 * violated.start
    shorter = cell.clearance_ranges([[0], [3]], margin=0.01, max_pose_error=0.01)[0]
    assert 3 * shorter.end == pytest.approx(2 - 2 * math.asin(0.5 * 0.23), abs=2e-3)
    with pytest.raises(InputError, match="resolution: 0 is not at least 1e-9"):
        cell.clearance_ranges([[0], [3]], resolution=0)


def test_a_path_is_followed_from_pose_to_pose() -> None:
    stops = np.tile(np.eye(4), (3, 1, 1))
    stops[:, 0, 3] = [-3, -2, 2]
    path = PosePath([0, 1, 2], stops)
    assert path.end == 2 and path.pose(1.5)[0, 3] == pytest.approx(0)
    hit = first_contact(BALL, BALL, path, duration=2)
    assert hit is not None and hit.time == pytest.approx(1 + 1.8 / 4, abs=1e-3)
    again = first_contact(BALL, BALL, path)
    assert again is not None and again.time == hit.time
    assert first_contact(BALL, BALL, path, duration=1) is None
    assert first_contact(BALL, BALL, PosePath(np.arange(2), [HERE, HERE])).kind == "overlapping"  # type: ignore[union-attr]
    for times, poses in (([0, 1], stops), ([0, 1, 1], stops), ([], []), ([0, 1, math.inf], stops)):
        with pytest.raises(InputError):
            PosePath(times, poses)


def test_a_path_turns_as_often_as_its_spins_say() -> None:
    here = np.tile(np.eye(4), (2, 1, 1))
    path = PosePath([0, 2], here, angular_velocities=[[0, 0, 7 * math.pi]])
    angle = 0.3 * 7 * math.pi
    assert path.pose(0.3)[:2, 0] == pytest.approx([math.cos(angle), math.sin(angle)], abs=1e-12)
    again = pickle.loads(pickle.dumps(path))
    assert again.pose(0.3) == pytest.approx(path.pose(0.3))
    # The arm passes a post on its side after a quarter of the first turn.
    rod = Body.box(2, 0.05, 0.05)
    hit = first_contact(rod, BALL, path, Motion([0, 1, 0]))
    assert hit is not None and hit.time < 2 / 14
    assert is_free(rod, BALL, PosePath([0, 2], here), Motion([0, 1, 0]))
    for angular_velocities in ([[0, 0, 1]], [[0, 0, math.nan]], [[0, 0, 0]] * 2, [0, 0, 0]):
        with pytest.raises(InputError):
            PosePath([0, 2], here, angular_velocities=angular_velocities)


def test_what_is_no_motion_is_refused() -> None:
    with pytest.raises(TypeError, match="motion_a: a Motion, a PosePath or a LinkTrajectory is needed, not list"):
        first_contact(BALL, BALL, [1, 2, 3])  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="motion_b"):
        is_free(BALL, BALL, None, arm())  # type: ignore[arg-type]


def test_bodies_may_be_the_same_object() -> None:
    chain = arm()
    moves = chain.link_trajectory("tip", [0, 0], [1, 1])
    del chain
    assert distance(BALL, BALL, moves.pose(0)).upper == pytest.approx(2.8)
    assert first_contact(BALL, BALL, moves, moves).kind == "overlapping"  # type: ignore[union-attr]


def test_a_query_is_as_long_as_what_moves() -> None:
    chain = arm()
    folds = chain.link_trajectory("tip", [0, 0], [0, math.pi], duration=5, seen_from="base")
    hit = first_contact(BALL, Body.sphere(1), folds)
    assert hit is not None and 2.5 < hit.time < 5
    with pytest.raises(InputError, match="duration: 6 is later than 5"):
        first_contact(BALL, BALL, folds, duration=6)
    with pytest.raises(InputError, match="different times"):
        first_contact(BALL, BALL, folds, chain.link_trajectory("upper", [0, 0], [1, 0]))
    assert first_contact(BALL, BALL, folds, chain.link_trajectory("upper", [0, 0], [1, 0]), 0.5) is None


def test_everything_that_moves_is_pickled() -> None:
    random = np.random.default_rng(1)
    for _ in range(20):
        turned: list[float] = random.normal(size=4).tolist()
        origin: Any = (random.normal(size=3), turned)
        joints = [
            Joint.fixed("mount", "world", "base", origin),
            Joint.revolute("hinge", "base", "upper", origin, random.normal(size=3), [-4, 4]),
            Joint.prismatic("slide", "upper", "fore", origin, random.normal(size=3)),
            Joint.prismatic("follower", "upper", "shield", origin, mimic=("slide", 2, 0.1)),
        ]
        robot = Robot(joints, {"fore": BALL, "base": [(BALL, origin)]}, [("fore", "base")])
        link = robot.link_trajectory("fore", [0, 0], [1, 2], 3)
        seen = robot.link_trajectory("fore", [0, 0], [1, 2], 3, "shield")
        motion = Motion(origin[0], turned, *random.normal(size=(3, 3)))
        between = Motion.between(origin, (random.normal(size=3), random.normal(size=4)), 2, [1, 2, 3])
        path = PosePath([1, 2], [origin, motion.pose(3)], [1, 2, 3])
        for moves in (link, seen, motion, between, path, Motion.still(origin)):
            again = pickle.loads(pickle.dumps(moves))
            assert repr(again) == repr(moves)
            assert np.array_equal(again.pose(0.7), moves.pose(0.7))
        copied = copy.deepcopy(robot)
        assert repr(copied) == repr(robot) and copied.checked_pairs == robot.checked_pairs
        assert [repr(joint) for joint in pickle.loads(pickle.dumps(joints))] == [repr(joint) for joint in joints]
        for place in ("shield", "fore", "base"):
            assert copied.pose(place, [1, 1]).tolist() == robot.pose(place, [1, 1]).tolist()


def test_poses_of_float32_are_taken() -> None:
    random = np.random.default_rng(2)
    for _ in range(100):
        pose = (Motion([1, 2, 3], random.normal(size=4).tolist()).pose(0)).astype(np.float32)
        assert Motion.still(pose).pose(0) == pytest.approx(pose, abs=1e-6)
    pose[0, 0] += 1e-3
    with pytest.raises(InputError, match="is off by"):
        Motion.still(pose)
