"""Certifies the openings of a gripper of four-bar linkages, its contact with a ball, and the path of an arm with both.

    pip install example-robot-data matplotlib scipy
    python gripper.py [PLOT.png]

Lengths are in metres. The time on the path of the fingers is the angle of their cranks in degrees; 90 is upright.
"""

# %% Two fingers: each has a coupler with a pad, on a crank and a rocker
import sys
from importlib.metadata import files

import numpy as np
from matplotlib.figure import Figure
from scipy.interpolate import CubicSpline, PPoly

from rigid_ccd import Body, Cell, Joint, Robot

BAR, COUPLER, GROUND, RADIUS = 0.050, 0.020, 0.022, 0.004  # crank and rocker are as long, and all bars are as thick
PAD, PAD_SIZE, BALL, BALL_RADIUS = [-0.006, 0.020, 0], [0.004, 0.030, 0.020], [0, 0.078, 0], 0.015
UPRIGHT, ALONG_X, TURNED = [0, 0, 0, 1], [0, 0.5**0.5, 0, 0.5**0.5], [0, 1, 0, 0]
bar, coupler = [(Body.capsule(RADIUS, size / 2), ([size / 2, 0, 0], ALONG_X)) for size in (BAR, COUPLER)]
parts = {"crank": [bar], "rocker": [bar], "coupler": [coupler, (Body.box(size=PAD_SIZE), (PAD, UPRIGHT))]}
joints = [
    Joint.revolute("crank", "frame", "crank", ([0.014, 0.010, 0], UPRIGHT)),
    Joint.revolute("elbow", "crank", "coupler", ([BAR, 0, 0], UPRIGHT)),
    Joint.revolute("rocker", "frame", "rocker", ([0.014 + GROUND, 0.010, 0], UPRIGHT)),
]
finger = Robot(joints, parts, may_touch=[("coupler", "rocker")])  # the pin that closes the loop
palm = {"palm": [(Body.box(size=(0.10, 0.04, 0.03)), ([0, -0.02, 0], UPRIGHT))]}
gripper = Robot.combined({"": Robot([], palm), "right": finger, "left": finger}, {"left": ([0, 0, 0], TURNED)})


# %% From open to closed: a spline through configurations in which both loops are closed
def closed(degrees: float | np.ndarray) -> np.ndarray:
    crank = np.radians(degrees)
    x, y = GROUND - BAR * np.cos(crank), -BAR * np.sin(crank)  # from the coupler's pin to that of the rocker
    tilt = np.arctan2(y, x) + np.arccos((COUPLER**2 + x**2 + y**2 - BAR**2) / (2 * COUPLER * np.hypot(x, y)))
    rocker = np.arctan2(COUPLER * np.sin(tilt) - y, COUPLER * np.cos(tilt) - x)
    return np.tile(np.stack([crank, tilt - crank, rocker], axis=-1), 2)


stops, fine = np.linspace(30, 96, 67), np.linspace(30, 96, 6601)
travel = CubicSpline(stops, closed(stops))
error = 0.1 * np.abs(travel(fine) - closed(fine))[:, :3].sum(axis=1).max()  # no point is 0.1 m from a pin of its finger

# %% Where do palm, bars and pads keep 0.5 mm from each other?
cell = Cell(gripper)
ranges = cell.clearance_ranges(travel, margin=5e-4, max_pose_error=error, tolerance=1e-6)
print(*(f"{each.clearance:10} {each.start:.3f}° to {each.end:.3f}°" for each in ranges), sep="\n")
pieces = [PPoly(travel.c[:, k : k + 1], travel.x[k : k + 2]) for k in range(len(stops) - 1)]
lower = cell.answer_paths(pieces, question="closest-approach", tolerance=1e-5)["distance_lower"] - 2 * error

# %% Where does a pad touch a ball of 30 mm?
cell.add_obstacle("ball", Body.sphere(BALL_RADIUS), (BALL, UPRIGHT))
touch = cell.first_contact(travel, tolerance=1e-6)
assert touch is not None
print(f"{touch.a} touches {touch.b} at {touch.time:.3f}°, at {np.round(touch.witness_b, 4)}")

# %% The same by hand: the end of the crank is nearest to the rocker, and the ball is outside of a box
crank, _, rocker = closed(np.array([ranges[0].end, ranges[-1].start]))[:, :3].T
gaps = BAR * np.sin(crank - rocker) + GROUND * np.sin(rocker) - 2 * RADIUS
ball = np.linalg.inv(gripper.pose("right/coupler", closed(touch.time))) @ [*BALL, 1]
gap = np.linalg.norm(np.maximum(np.abs(ball[:3] - PAD) - np.array(PAD_SIZE) / 2, 0)) - BALL_RADIUS
assert gaps[0] <= 5e-4 <= gaps[1] and -2 * error <= gap <= 1e-6 + 2 * error

# %% The plot
figure = Figure(figsize=(8, 4), layout="constrained")
axes = figure.subplots()
axes.stairs(1e3 * lower, stops, baseline=None, label="certified clearance, without the ball")
axes.axhline(0.5, color="#d1495b", linestyle="--", label="required")
axes.axvline(touch.time, color="0.5", linestyle=":", label="the pads touch the ball")
axes.set(xlim=stops[[0, -1]], ylim=(0, None), xlabel="angle of the cranks (degrees)", ylabel="clearance (mm)")
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "gripper.png", dpi=150)

# %% An arm carries the gripper with the ball over a wall
package = {path.name: path.locate() for path in files("example-robot-data") or []}
arm = Robot.from_urdf(package["ur5_robot.urdf"], package["ur5.srdf"])
flange = ([0, 0, 0.041], [0.5**0.5, 0.5**0.5, 0, 0])
both = Cell(Robot.combined({"": arm, "gripper": gripper}, {"gripper": flange}, carriers={"gripper": "tool0"}))
both.add_obstacle("wall", Body.box(size=(0.4, 0.02, 0.135)), ([0.55, 0, 0.0325], UPRIGHT))
pads = [f"gripper/{side}/coupler" for side in ("right", "left")]
both.attach("ball", Body.sphere(BALL_RADIUS), "gripper/palm", (BALL, UPRIGHT), may_touch=pads)
ends = [[-0.8, -1.4, 1.9, -2.07, -1.57, 0], [0.8, -1.4, 1.9, -2.07, -1.57, 0]]
edge = [[*end, *closed(touch.time)] for end in ends]
assert both.is_free(edge, tolerance=1e-5)
print(f"An edge of the arm is free, by {1e3 * both.closest_approach(edge, tolerance=1e-5).lower:.2f} mm")
