"""Queries, against closed forms."""

import math
import pickle
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

from rigid_ccd import (
    Body,
    Contact,
    Distance,
    InputError,
    Motion,
    PosePath,
    UnresolvedError,
    closest_approach,
    distance,
    first_contact,
    is_free,
)

BALL = Body.sphere(0.5)
WALL = Body.box(0.1, 5, 5)


@pytest.mark.parametrize("speed", [2.5, 4, 100, 1e5])
def test_a_ball_flies_at_a_wall(speed: float) -> None:
    flies = Motion([-3, 0, 0], velocity=[speed, 0, 0], angular_velocity=[0, 3, 50])
    exact = 2.4 / speed
    hit = first_contact(BALL, WALL, flies)
    assert isinstance(hit, Contact) and hit.kind == "contact"
    assert exact - 1.01e-3 / speed <= hit.time <= exact
    assert hit.normal == pytest.approx((1, 0, 0), abs=1e-6)
    assert hit.witness_b[0] == pytest.approx(-0.1, abs=1e-9)
    assert hit.distance is not None and 0 <= hit.distance[0] <= hit.distance[1] <= 1e-3
    assert not is_free(BALL, WALL, flies)
    assert eval(repr(hit)) == pickle.loads(pickle.dumps(hit)) == hit


def test_a_slow_ball_stays_apart() -> None:
    flies = Motion([-3, 0, 0], velocity=[2, 0, 0])
    assert first_contact(BALL, WALL, flies) is None
    assert is_free(BALL, WALL, flies)
    nearest = closest_approach(BALL, WALL, flies, tolerance=1e-6)
    assert isinstance(nearest, Distance)
    assert nearest.lower <= 0.4 <= nearest.upper + 1e-12 and nearest.upper - nearest.lower <= 1e-6
    assert nearest.time == pytest.approx(1)
    assert eval(repr(nearest)) == pickle.loads(pickle.dumps(nearest)) == nearest


def test_bounds_hold_for_the_cylinders_that_bodies_exceed() -> None:
    # The sides are 0.1 apart, and corners of the enclosing polytopes face each other.
    wheel = Body.cylinder(1, 1, 0.01)
    half = math.pi / 48
    turned = [0, 0, math.sin(half), math.cos(half)]
    places = ([2.1, 0, 0], turned), ([0, 0, 0], turned)
    found = distance(wheel, wheel, *places)
    assert found.lower < 0.09 and 0.1 <= found.upper <= found.lower + 2 * wheel.excess + 1e-3
    a, b = (Motion.still(place) for place in places)
    stored = pickle.loads(pickle.dumps(wheel))
    assert distance(stored, stored, *places).upper == found.upper
    flies = Motion([2.1, -1, 0], turned, velocity=[0, 2, 0])
    for clearance, said in [(0.05, "kept"), (0.0995, "unverified"), (0.13, "violated")]:
        assert closest_approach(wheel, wheel, flies, b, clearance=clearance).clearance == said


def test_a_clearance_is_kept_or_violated() -> None:
    flies = Motion([-3, 0, 0], velocity=[2, 0, 0])
    kept = closest_approach(BALL, WALL, flies, clearance=0.3)
    assert kept.clearance == "kept" and 0.3 <= kept.lower <= 0.4 and kept.time is None
    violated = closest_approach(BALL, WALL, flies, clearance=0.45)
    assert violated.clearance == "violated" and 0.4 - 1e-9 <= violated.upper < 0.45 and violated.time is not None
    between = closest_approach(BALL, WALL, flies, clearance=0.4, tolerance=1e-2)
    assert between.clearance == "unverified" and between.lower <= 0.4 <= between.upper + 1e-12
    assert closest_approach(BALL, WALL, flies).clearance is None
    with pytest.raises(InputError, match="clearance"):
        closest_approach(BALL, WALL, flies, clearance=-1)
    with pytest.raises(TypeError, match="clearance"):
        distance(BALL, WALL, clearance=1)  # type: ignore[call-arg]


def test_what_touches_at_the_start_is_told() -> None:
    inside = first_contact(BALL, WALL)
    assert inside is not None and (inside.kind, inside.time) == ("overlapping", 0)
    beside = first_contact(BALL, WALL, Motion([0.6, 0, 0]))
    assert beside is not None and beside.kind == "touching"
    with pytest.raises(AttributeError):
        beside.time = 1  # type: ignore[misc]


def test_distances_at_rest() -> None:
    pose = np.eye(4)
    pose[:3, 3] = [2, 0, 0]
    for given in (pose, pose.tolist(), ([2, 0, 0], np.eye(3)), ([2, 0, 0], [0, 0, 0, 1])):
        found = distance(BALL, WALL, given, tolerance=1e-9)
        assert found.lower <= 1.4 <= found.upper + 1e-12
        assert found.witness_a is not None and found.witness_a[0] == pytest.approx(1.5)


def test_rotations_come_in_three_forms() -> None:
    half = math.pi / 4
    turned: list[Any] = [
        [0, 0, math.sin(half), math.cos(half)],
        [[0, -1, 0], [1, 0, 0], [0, 0, 1]],
        np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], dtype=np.float32),
    ]
    try:
        from scipy.spatial.transform import Rotation

        turned.append(Rotation.from_euler("z", 90, degrees=True))
    except ImportError:
        pass
    for rotation in turned:
        pose = Motion([1, 2, 3], rotation).pose(0.5)
        assert pose == pytest.approx(np.array([[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]), abs=1e-15)


def test_motions_between_poses() -> None:
    start, end = np.eye(4), np.eye(4)
    end[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    end[:3, 3] = [4, 0, 0]
    motion = Motion.between(start, end, duration=2)
    assert motion.pose(0) == pytest.approx(start, abs=1e-15)
    assert motion.pose(2) == pytest.approx(end, abs=1e-12)


def test_questions_end_where_a_motion_between_poses_does() -> None:
    passes = Motion.between(([-3, 0, 0], [0, 0, 0, 1]), ([3, 0, 0], [0, 0, 0, 1]), duration=4)
    assert (passes.end, Motion.between(np.eye(4), np.eye(4)).end, Motion().end) == (4, 1, None)
    assert pickle.loads(pickle.dumps(passes)).end == 4
    for a, b, motion_a, motion_b in ((BALL, WALL, passes, None), (WALL, BALL, Motion(), passes)):
        assert not is_free(a, b, motion_a, motion_b)
        assert is_free(a, b, motion_a, motion_b, duration=1)
        contact = first_contact(a, b, motion_a, motion_b, tolerance=1e-6)
        assert contact is not None and 1.6 - 1e-6 <= contact.time <= 1.6
        assert closest_approach(a, b, motion_a, motion_b).lower <= 0
    with pytest.raises(InputError, match="end at different times"):
        is_free(BALL, WALL, passes, PosePath([0, 3], [np.eye(4), np.eye(4)]))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"position": [1, 2]}, "position: 3 numbers"),
        ({"position": [1, 2, math.nan]}, "position: entry 2 is NaN"),
        ({"position": "abc"}, "position"),
        ({"rotation": [[2, 0, 0], [0, 1, 0], [0, 0, 1]]}, "no rotation"),
        ({"rotation": [[-1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "no rotation"),
        ({"rotation": [0, 0, 0, 0]}, "orientation|quaternion|rotation"),
        ({"rotation": [1, 0]}, "rotation: a matrix"),
        ({"velocity": [math.inf, 0, 0]}, "velocity: entry 0 is inf"),
    ],
)
def test_bad_motions_are_refused(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        Motion(**arguments)  # type: ignore[arg-type]


def test_bad_settings_are_refused() -> None:
    flies = Motion([-3, 0, 0], velocity=[4, 0, 0])
    for settings in ({"duration": -1}, {"tolerance": 0}, {"tolerance": math.nan}, {"margin": -1}, {"deadline": -1}):
        with pytest.raises(InputError):
            first_contact(BALL, WALL, flies, **settings)
    with pytest.raises(TypeError, match=r"b: a Body.*from_file.*not str"):
        first_contact(BALL, "wall")  # type: ignore[arg-type]


def test_a_used_up_budget_says_what_is_proven() -> None:
    rods = Body.capsule(0.01, 2)
    flies = Motion([-3, 0, 0], velocity=[4, 0, 0], angular_velocity=[300, 200, 100])
    with pytest.raises(UnresolvedError, match="the budget is spent: a larger tolerance") as error:
        first_contact(rods, rods, flies, tolerance=1e-9, budget=1)
    assert error.value.safe_until is not None and 0 <= error.value.safe_until <= 1


def test_threads_give_the_same_bits() -> None:
    def ask(speed: float) -> float:
        hit = first_contact(BALL, WALL, Motion([-3, 0, 0], velocity=[speed, 0, 0]))
        assert hit is not None
        return hit.time

    speeds = [3 + 0.01 * k for k in range(400)]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(ask, speeds)) == [ask(speed) for speed in speeds]


def test_more_time_does_not_prove_less() -> None:
    from test_tables import knot

    body, flies = knot(600), Motion([3.3, 0, 0], angular_velocity=[6e5, 6e5, 0])
    for deadline in (0.05, 0.2, 0.3, 0.4):
        with pytest.raises(UnresolvedError) as error:
            first_contact(body, body, flies, tolerance=1e-9, deadline=deadline)
        assert error.value.safe_until is not None and error.value.safe_until > 0
