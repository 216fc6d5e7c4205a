"""Valid input that is probably a mistake gives a warning; usual input does not."""

import math
import warnings
from typing import Any

import numpy as np
import pytest

from rigid_ccd import Body, Joint, Motion, Path, Robot, closest_approach, distance, first_contact, first_contacts, is_free

BALL, WALL = Body.sphere(0.5), Body.box(0.1, 5, 5)
PART = Body.sphere(0.0005)


@pytest.mark.parametrize(
    ("words", "ask"),
    [
        ("the tolerance is large", lambda: first_contact(PART, WALL)),
        ("the tolerance is large", lambda: is_free(WALL, PART)),
        ("the tolerance is large", lambda: distance(PART, WALL)),
        ("the tolerance is large", lambda: first_contacts(PART, WALL, {"a_px": [1.0]})),
        ("the tolerance is large", lambda: closest_approach(BALL, WALL, tolerance=0.11)),
        ("makes many turns", lambda: first_contact(BALL, WALL, Motion([3, 0, 0], spin=[0, 0, 90]))),
        ("makes many turns", lambda: first_contacts(BALL, WALL, {"a_px": [3.0], "a_wz": [-360.0]})),
        ("far from unit length", lambda: Motion([0, 0, 0], [1, 1, 0, 0])),
        ("far from unit length", lambda: Motion.still(([0, 0, 0], [1e-200, 0, 0, 0]))),
        ("far from unit length", lambda: first_contacts(BALL, WALL, quaternions(2.0))),
        ("far from unit length", lambda: first_contacts(BALL, WALL, {"t": [0.0, 1.0], **quaternions(2.0)})),
        ("a joint's position", lambda: arm().motion("upper", [0, 0], [90, 0])),
    ],
)
def test_traps_are_warned_of_once(words: str, ask: Any) -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        ask()
    texts = [str(one.message) for one in told]
    assert len(texts) == 1 and words in texts[0], texts
    assert told[0].filename == __file__ and told[0].category is UserWarning


def test_what_is_usual_is_not() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for spin in (0, 1, 10, math.pi, 100, 20 * math.pi, 104.72):
            first_contact(BALL, WALL, Motion([3, 0, 0], spin=[0, 0, spin]))
        # Some of these numbers may be degrees, but not all of them.
        speeds = np.linspace(0, 180, 25)
        first_contacts(BALL, WALL, {"a_px": np.full(25, 3.0), "a_wz": speeds})
        first_contacts(BALL, WALL, {"a_px": [3.0, 3.0], **quaternions(1.01)})
        first_contact(Body.sphere(0.01), WALL)
        first_contact(Body.sphere(0), WALL, Motion([3, 0, 0]))
        first_contact(Body.box(1, 1, 1e-6), WALL, Motion([3, 0, 0]))
        arm().motion("upper", [0, 0], [2 * math.pi, 90])
        Path([0, 1], np.tile(np.eye(4), (2, 1, 1)))


def test_a_warning_may_be_an_error() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning, match="turns"):
            first_contact(BALL, WALL, Motion([3, 0, 0], spin=[0, 0, 90]))


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
