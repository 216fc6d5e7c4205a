"""Brackets the least clearance of four mechanisms whose answers are known, and prints a table.

Needs the Python package rigid_ccd and NumPy. Exits with 1 if a bracket is wrong.

    python ccd-bench/scripts/mechanisms.py
"""

import math
import sys
import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from rigid_ccd import Body, Cell, Joint, Robot

TOLERANCE = 1e-6
TURN = 2 * math.pi


def at(*position: float) -> tuple[list[float], list[float]]:
    """Returns a pose without rotation."""
    return [*position, *[0.0] * (3 - len(position))], [0, 0, 0, 1]


@dataclass
class Mechanism:
    """A cell, a path of it, and what is known of the clearance.

    `exact` is the least clearance of the mechanism; its bodies and its path differ from the exact ones by `error`.
    """

    name: str
    cell: Cell
    path: Any
    exact: float
    error: float = 0.0


def involute(angle: float) -> float:
    return math.tan(angle) - angle


def gear(module: float, teeth: int, thickness: float, points: int = 40) -> tuple[Body, float]:
    """Returns a spur gear with a pressure angle of 20 degrees, a tooth on the x axis, and the error of its flanks."""
    pressure = math.radians(20)
    pitch = module * teeth / 2
    base, tip, root = pitch * math.cos(pressure), pitch + module, pitch - 1.25 * module
    half = math.pi / (2 * teeth) + involute(pressure)
    start = max(base, root)
    # Equal steps of the roll angle.
    rolls = np.linspace(math.sqrt((start / base) ** 2 - 1), math.sqrt((tip / base) ** 2 - 1), points)
    radii, angles = base * np.sqrt(1 + rolls**2), half - (rolls - np.arctan(rolls))
    profile = []
    for tooth in range(teeth):
        middle = TURN * tooth / teeth
        flank = [(root, -angles[0]), *zip(radii, -angles, strict=True)]
        other = [*zip(radii[::-1], angles[::-1], strict=True), (root, angles[0])]
        for radius, angle in [*flank, *other]:
            profile.append([radius * math.cos(middle + angle), radius * math.sin(middle + angle)])
    around = np.array(profile)
    count = len(around)
    levels = [np.column_stack([around, np.full(count, z)]) for z in (-thickness / 2, thickness / 2)]
    centers = [[0, 0, -thickness / 2], [0, 0, thickness / 2]]
    following = (np.arange(count) + 1) % count
    here = np.arange(count)
    faces = np.concatenate(
        [
            np.column_stack([here, following, count + following]),
            np.column_stack([here, count + following, count + here]),
            np.column_stack([np.full(count, 2 * count), following, here]),
            np.column_stack([np.full(count, 2 * count + 1), count + here, count + following]),
        ]
    )
    # The chord of an arc of an involute is off by its length squared, over eight radii of curvature.
    step = rolls[1] - rolls[0]
    sagitta = max(base * (roll + step) ** 2 * step**2 / (8 * roll) for roll in rolls[:-1] if roll > 0)
    return Body(np.vstack([*levels, centers]), faces), sagitta


def gear_pair() -> Mechanism:
    """Two involute gears, 0.1 mm farther apart than where their pitch circles touch. A tooth of one is in the middle of a
    gap of the other. The normal distance of their flanks does not change while they turn."""
    module, teeth = 0.002, (20, 40)
    pressure = math.radians(20)
    apart = module * sum(teeth) / 2 + 1e-4
    bases = module * sum(teeth) / 2 * math.cos(pressure)
    exact = bases * (involute(math.acos(bases / apart)) - involute(pressure))
    (small, first), (large, second) = (gear(module, count, 0.01) for count in teeth)
    joints = [
        Joint.revolute("pinion", "frame", "small gear"),
        Joint.fixed("mount", "frame", "shaft", ([apart, 0, 0], [0, 0, 0, 1])),
        Joint.revolute("wheel", "shaft", "large gear", mimic=("pinion", -0.5, math.pi / 40)),
    ]
    cell = Cell(Robot(joints, {"small gear": small, "large gear": large}))
    return Mechanism("gear pair, one tooth on", cell, [[0.0], [TURN / 20]], exact, first + second)


def hinge_with_stop() -> Mechanism:
    """A lid with a round edge, which turns from -90 to 40 degrees, and a ball at 46 degrees."""
    hinge = Joint.revolute("hinge", "frame", "lid")
    cell = Cell(Robot([hinge], {"lid": [(Body.capsule(0.02, 0.2), at(0.3))]}))
    stop = math.radians(46)
    cell.add_obstacle("stop", Body.sphere(0.005), at(0.3 * math.cos(stop), 0.3 * math.sin(stop)))
    exact = 2 * 0.3 * math.sin(math.radians(3)) - 0.025
    return Mechanism("hinge with a stop", cell, [[-math.pi / 2], [math.radians(40)]], exact)


def rod(length: float, height: float) -> list[Any]:
    """Returns a rod along the x axis from the origin of its link, at a height."""
    along_x = [math.sqrt(0.5), 0, math.sqrt(0.5), 0]
    return [(Body.capsule(0.004, length / 2), ([length / 2, 0, height], along_x))]


def crank_slider() -> Mechanism:
    """A crank, a rod and a slider, which comes within 0.5 mm of a wall when the rod is stretched."""
    crank, length, gap = 0.05, 0.15, 5e-4
    joints = [
        Joint.revolute("crank", "frame", "crank"),
        Joint.revolute("pin", "crank", "rod", at(crank)),
        Joint.prismatic("guide", "frame", "slider", axis=[1, 0, 0]),
    ]
    bodies: dict[str, Any] = {"crank": rod(crank, 0.02), "rod": rod(length, 0.04), "slider": Body.box(0.02, 0.02, 0.01)}
    cell = Cell(Robot(joints, bodies, [("rod", "slider"), ("crank", "slider")]))
    cell.add_obstacle("wall", Body.box(0.01, 0.1, 0.1), at(crank + length + 0.02 + gap + 0.01))
    turn = np.linspace(-math.pi, math.pi, 2001)
    tilt = -np.arcsin(crank / length * np.sin(turn))
    slide = crank * np.cos(turn) + length * np.cos(tilt)
    # The interpolation of a curve is off by at most an eighth of its second derivative and of the squared step.
    ratio = crank / length
    curvature = crank * (1 + ratio / (1 - ratio**2) ** 1.5)
    error = curvature * (turn[1] - turn[0]) ** 2 / 8
    return Mechanism("crank and slider, a turn", cell, np.column_stack([turn, tilt - turn, slide]), gap, error)


def four_bar() -> Mechanism:
    """A crank, a coupler and a rocker. A ball on the coupler passes a ball at rest."""
    ground, crank, coupler, rocker = 0.1, 0.03, 0.09, 0.07
    knob, rest = np.array([0.05, 0.04]), np.array([0.052, 0.085])

    def closed(turn: Any) -> tuple[Any, Any]:
        """Returns the angles of the coupler and of the rocker at which the loop is closed."""
        across = np.stack([ground - crank * np.cos(turn), -crank * np.sin(turn)])
        diagonal, bearing = np.hypot(*across), np.arctan2(across[1], across[0])
        tilt = bearing + np.arccos((coupler**2 + diagonal**2 - rocker**2) / (2 * coupler * diagonal))
        top = [coupler * np.cos(tilt) - across[0], coupler * np.sin(tilt) - across[1]]
        return tilt, np.arctan2(top[1], top[0])

    def knob_at(turn: Any, tilt: Any) -> Any:
        x = crank * np.cos(turn) + knob[0] * np.cos(tilt) - knob[1] * np.sin(tilt)
        y = crank * np.sin(turn) + knob[0] * np.sin(tilt) + knob[1] * np.cos(tilt)
        return np.stack([x, y])

    joints = [
        Joint.revolute("crank", "frame", "crank"),
        Joint.revolute("elbow", "crank", "coupler", at(crank)),
        Joint.revolute("rocker", "frame", "rocker", at(ground)),
    ]
    bodies = {
        "crank": rod(crank, 0.0),
        "coupler": [*rod(coupler, 0.02), (Body.sphere(0.005), at(*knob, 0.06))],
        "rocker": rod(rocker, 0.04),
    }
    cell = Cell(Robot(joints, bodies, [("coupler", "rocker")]))
    cell.add_obstacle("ball", Body.sphere(0.005), at(*rest, 0.06))
    turn = np.linspace(0, TURN, 4001)
    tilt, swing = closed(turn)
    path = np.column_stack([turn, tilt - turn, np.unwrap(swing)])
    fine = np.linspace(0, TURN, 4_000_001)
    exact_tilt = closed(fine)[0]
    straight = np.interp(fine, turn, tilt)
    error = np.max(np.hypot(*(knob_at(fine, exact_tilt) - knob_at(fine, straight))))
    distances = np.hypot(*(knob_at(fine, exact_tilt) - rest[:, None]))
    return Mechanism("four-bar linkage, a turn", cell, path, np.min(distances) - 0.01, error)


def main() -> int:
    wrong = 0
    print("| mechanism | exact, mm | proven, mm | width, mm | configurations | ms |\n|---|---|---|---|---|---|")
    for make in (hinge_with_stop, gear_pair, crank_slider, four_bar):
        known = make()
        path = np.array(known.path)
        times = []
        for _ in range(5):
            begin = time.perf_counter()
            found = known.cell.closest_approach(path, tolerance=TOLERANCE)
            times.append(time.perf_counter() - begin)
        lower, upper = found.lower - known.error, found.upper + known.error
        is_right = lower <= known.exact <= upper and found.upper - found.lower <= 1.001 * TOLERANCE
        wrong += not is_right
        millimetres = [f"{1000 * value:.5f}" for value in (known.exact, lower, upper, upper - lower)]
        exact, lowest, highest, width = millimetres
        verdict = "" if is_right else " **wrong**"
        took = 1000 * sorted(times)[2]
        print(f"| {known.name} | {exact} | {lowest} to {highest}{verdict} | {width} | {len(path)} | {took:.2f} |")
    return wrong


if __name__ == "__main__":
    sys.exit(main())
