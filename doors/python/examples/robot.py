"""Certifies edges of a planner for a Franka Panda in a cell, and draws its clearance while the base turns.

    pip install example-robot-data matplotlib
    python robot.py [PLOT.png]

The cells run in order, as a script or in an editor that knows `# %%`. Lengths are in metres, angles in radians.
"""

# %% The robot
# The wheel of example-robot-data carries URDF, SRDF and meshes. The SRDF lists the pairs of links that need no check:
# neighbours, and pairs that never meet.
import sys
from importlib.metadata import files

import numpy as np
from matplotlib.figure import Figure

from rigid_ccd import Body, Cell, Robot

package = {path.name: path.locate() for path in files("example-robot-data") or []}
robot = Robot.from_urdf(package["panda.urdf"], package["panda.srdf"])
low, high = robot.limits.T
print(f"{robot!r}: {len(robot.checked_pairs)} pairs of links to check")

# %% The cell around it: boards, a post, and cables of 6 mm
UPRIGHT = [0, 0, 0, 1]
boxes = {  # size, position and rotation
    "table": ((1.6, 1.6, 0.04), [0, 0, -0.05], UPRIGHT),
    "shelf": ((0.4, 0.3, 0.015), [0.45, 0.40, 0.60], UPRIGHT),
    "guard": ((0.6, 0.002, 0.5), [0, -0.60, 0.30], UPRIGHT),
    "post": ((0.03, 0.03, 1.0), [-0.35, 0.45, 0.50], UPRIGHT),
}
random = np.random.default_rng(5)
for k in range(12):
    angle, radius, height = random.uniform([-np.pi, 0.3, 0], [np.pi, 1.0, 1.1])
    w, *xyz = random.normal(size=4)
    turned = np.array([*xyz, w])
    at = [radius * np.cos(angle), radius * np.sin(angle), height]
    boxes[f"cable {k}"] = (0.006, 0.006, 0.3), at, list(turned / np.linalg.norm(turned))
cell = Cell(robot)
for name, (size, position, rotation) in boxes.items():
    cell.add_obstacle(name, Body.box(size=size), (position, rotation))

# %% Edges of a planner
# Each edge begins where the arm is free, and turns joints by up to 1.5 radians. A certified edge is free along its
# whole length.
TOLERANCE = 1e-4  # an edge that keeps this much clearance is certified
starts = random.uniform(low, high, (1200, len(low)))
starts = starts[cell.answer_edges(starts, starts, tolerance=TOLERANCE)["status"] == "free"][:400]
ends = np.clip(starts + random.uniform(-1.5, 1.5, starts.shape), low, high)
certified = cell.answer_edges(starts, ends, tolerance=TOLERANCE)["status"] == "free"
print(f"{certified.sum()} of {len(starts)} edges are free")

# %% The same edges at equal steps
for steps in (5, 20, 100):
    fractions = np.linspace(0, 1, steps + 1)[:, None, None]
    stops = (starts + fractions * (ends - starts)).reshape(-1, len(low))
    is_free = (cell.answer_edges(stops, stops, tolerance=TOLERANCE)["status"] == "free").reshape(steps + 1, -1)
    missed = np.flatnonzero(is_free.all(axis=0) & ~certified)
    print(f"{steps:3} steps accept {len(missed)} edges that are not free")
    for k in missed[:1]:
        contact = cell.first_contact([starts[k], ends[k]], tolerance=TOLERANCE)
        if contact is not None:
            print(f"    edge {k}: {contact.a} meets {contact.b} at {contact.fraction:.4f} of it, at", contact.witness_b)

# %% A whole turn of the base
# In the interval from one angle to the next, the clearance is never less than `lower`.
POSE = [0.0, 0.6, -2.6, 1.1, 3.7, 1.6, 0.02]
angles = np.linspace(low[0], high[0], 241)
turn = np.column_stack([angles, np.tile(POSE, (len(angles), 1))])
stretches = cell.answer_edges(turn[:-1], turn[1:], question="closest-approach", tolerance=TOLERANCE)
lower = 1e3 * stretches["distance_lower"]
stops = turn[::6]
at_stops = 1e3 * cell.answer_edges(stops, stops, question="closest-approach", tolerance=TOLERANCE)["distance_upper"]
print(f"Least clearance over a turn of the base: {lower.min():.1f} mm; it seems {at_stops.min():.1f} mm at 41 steps")

# %% The plot
figure = Figure(figsize=(9, 4.5), layout="constrained")  # draws with Agg: no window
axes, degrees = figure.subplots(), np.degrees(angles)
axes.stairs(lower, degrees, fill=True, color="#2a6fbb", alpha=0.15)
axes.stairs(lower, degrees, baseline=None, color="#2a6fbb", label="certified: never nearer in each stretch")
axes.plot(degrees[::6], at_stops, ".", color="#d1495b", markersize=9, clip_on=False, label="distance at equal steps")
axes.set(xlim=degrees[[0, -1]], ylim=(0, None), xlabel="angle of joint 1 (degrees)", ylabel="clearance (mm)")
axes.set_title("A Panda turns about its base", loc="left")
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0, ncols=2)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "robot.png", dpi=150)
