"""Picks a can from a table with one of two arms, carries it to a shelf, and finds the contacts on other paths.

    python pick_and_place.py

Lengths are in metres, angles in radians. The can stands on the table when it is lifted: `start="leave"` allows it to
separate, and still finds every other contact.
"""

# %% An arm of a lift, two hinges and two fingers
from typing import Any

import numpy as np

from rigid_ccd import Body, Cell, Joint, Robot

UPRIGHT, TURNED = [0, 0, 0, 1], [0, 0, 1, 0]


def box(size: tuple[float, float, float], x: float = 0, y: float = 0, z: float = 0) -> list[Any]:
    return [(Body.box(size=size), ([x, y, z], UPRIGHT))]


joints = [
    Joint.prismatic("lift", "base", "carriage", ([0, 0, 0.3], UPRIGHT), limits=(-0.1, 0.6)),
    Joint.revolute("shoulder", "carriage", "upper", ([0.15, 0, 0], UPRIGHT), limits=(-2.2, 2.2)),
    Joint.revolute("elbow", "upper", "fore", ([0.3, 0, 0.08], UPRIGHT), limits=(-2.6, 2.6)),
    Joint.fixed("wrist", "fore", "hand", ([0.25, 0, 0], UPRIGHT)),
    Joint.prismatic("finger", "hand", "left finger", axis=[0, 1, 0], limits=(0, 0.05)),
    Joint.prismatic("right", "hand", "right finger", axis=[0, -1, 0], mimic=("finger", 1, 0)),
]
bodies = {
    "base": box((0.1, 0.1, 1), z=0.5),
    "carriage": box((0.05, 0.05, 0.05), x=0.08),
    "upper": box((0.3, 0.06, 0.04), x=0.15),
    "fore": box((0.25, 0.05, 0.04), x=0.125),
    "hand": box((0.04, 0.14, 0.02), z=-0.03),
    "left finger": box((0.02, 0.01, 0.1), y=0.005, z=-0.09),
    "right finger": box((0.02, 0.01, 0.1), y=-0.005, z=-0.09),
}
arm = Robot(joints, bodies)
both = Robot.combined({"": arm, "other": arm}, {"other": ([1.25, 0, 0], TURNED)})

# %% The cell: a table with the can, a shelf, and the other arm
can, in_hand = Body.cylinder(0.033, 0.06), ([0, 0, -0.12], UPRIGHT)
FINGERS = ["left finger", "right finger"]
cell = Cell(both)
cell.add_obstacle("table", Body.box(0.25, 0.4, 0.01), ([0.62, 0, 0.19], UPRIGHT))
cell.add_obstacle("shelf", Body.box(0.12, 0.1, 0.01), ([0.62, -0.22, 0.34], UPRIGHT))
print(cell)
ASIDE, IN_THE_WAY = (0, 2), (0.1, 0)  # lift and shoulder of the other arm


def at(lift: float, shoulder: float, elbow: float, finger: float, other: tuple[float, float] = ASIDE) -> list[float]:
    return [lift, shoulder, elbow, finger, *other, 0, 0.02]


PICK, PLACE, OPEN, CLOSED = (0.7, -0.9), (-0.7, 0.9), 0.05, 0.033

# %% Pick: the fingers come from above, open, and close
grasp = np.eye(4)
grasp[:3, 3] = in_hand[0]
cell.add_obstacle("can", can, both.pose("hand", at(0, *PICK, OPEN)) @ grasp)
assert cell.is_free([at(0.3, *PICK, OPEN), at(0, *PICK, OPEN)])
cell.remove_obstacle("can")
cell.attach("can", can, "hand", in_hand, may_touch=FINGERS)

# %% Carry: off the table, over the shelf and down to a millimetre above it
way = [at(0, *PICK, CLOSED), at(0.25, *PICK, CLOSED), at(0.25, *PLACE, CLOSED), at(0.151, *PLACE, CLOSED)]
assert not cell.is_free(way)  # the can touches the table at the start
assert cell.is_free(way, start="leave")
print("the way over the shelf is free")

# %% Every other contact is found
in_the_way = {
    "onto the shelf": [at(0.25, *PLACE, CLOSED), at(0.1, *PLACE, CLOSED)],
    "into the shelf": [at(0, *PICK, CLOSED), at(0.1, *PICK, CLOSED), at(0.1, *PLACE, CLOSED)],
    "into the other arm": [at(lift, *pose, CLOSED, IN_THE_WAY) for lift, pose in [(0, PICK), (0.25, PICK), (0.25, PLACE)]],
    "into the table": [at(0, *PICK, CLOSED), at(-0.05, *PICK, CLOSED)],
}
for name, path in in_the_way.items():
    contact = cell.first_contact(path, start="leave", tolerance=1e-5)
    assert contact is not None
    print(f"{name}: {contact.a} touches {contact.b} at {contact.time:.4f}")

# %% Place: the can stands on the shelf, the fingers open and leave it
shelved = at(0.15, *PLACE, CLOSED)
cell.detach("can")
cell.add_obstacle("can", can, both.pose("hand", shelved) @ grasp)
for finger in FINGERS:
    cell.allow_contact(finger, "can")
assert cell.is_free([shelved, at(0.15, *PLACE, OPEN)])
for finger in FINGERS:
    cell.forbid_contact(finger, "can")
assert cell.is_free([at(0.15, *PLACE, OPEN), at(0.5, *PLACE, OPEN), at(0.5, *PICK, OPEN)])
print("the can is on the shelf, and the arm is back")
