"""Edges of a planner for a Franka Panda: certified, and compared with checks at equal steps.

    pip install example-robot-data yourdfpy trimesh python-fcl matplotlib
    python robot.py [PLOT.png]

The cells run in order, as a script or in an editor that knows `# %%`. Lengths are in metres, angles in radians.
"""

# %% The robot
# The wheel of example-robot-data carries URDF, SRDF and meshes. The SRDF lists the pairs of links that need no check:
# neighbours, and pairs that never meet.
import sys
import tempfile
import time
from collections.abc import Callable
from importlib.metadata import files
from itertools import pairwise
from pathlib import Path

import numpy as np
import trimesh
import yourdfpy
from matplotlib.figure import Figure
from numpy.typing import ArrayLike
from trimesh.collision import CollisionManager

from rigid_ccd import Body, Cell, Robot

EDGES = 400
TOLERANCE = 1e-4  # an edge that keeps this much clearance is certified
ROUNDING = 1e-5  # FCL stops within 1e-6 of a distance; STL files hold 32-bit numbers

package = {path.name: path.locate() for path in files("example-robot-data") or []}
robot = Robot.from_urdf(package["panda.urdf"], package["panda.srdf"])
LOW, HIGH = robot.limits.T
print(f"{robot!r}: {len(robot.checked_pairs)} pairs of links to check")

# %% The cell around it
# Boards, a post, a ball, and cables of 6 mm.
cell = Cell(robot)
obstacles: dict[str, tuple[trimesh.Trimesh, np.ndarray]] = {}


def add(name: str, mesh: trimesh.Trimesh, at: ArrayLike, turned: np.ndarray | None = None) -> None:
    pose = np.eye(4) if turned is None else turned.copy()
    pose[:3, 3] = at
    obstacles[name] = mesh, pose
    cell.add(name, Body.from_trimesh(mesh), pose)


box, ball = trimesh.creation.box, trimesh.creation.icosphere
add("table", box((1.6, 1.6, 0.04)), [0, 0, -0.05])
add("shelf", box((0.4, 0.3, 0.015)), [0.45, 0.40, 0.60])
add("guard", box((0.6, 0.002, 0.5)), [0, -0.60, 0.30])
add("post", box((0.03, 0.03, 1.0)), [-0.35, 0.45, 0.50])
add("ball", ball(radius=0.08), [-0.50, -0.20, 0.60])
random = np.random.default_rng(4)
while len(obstacles) < 17:
    at = random.uniform([-0.8, -0.8, 0], [0.8, 0.8, 1.1])
    if np.hypot(*at[:2]) > 0.3:  # not in the robot's trunk
        turned = trimesh.transformations.random_rotation_matrix(random.random(3))
        add(f"cable {len(obstacles) - 4}", box((0.006, 0.006, 0.3)), at, turned)

# %% The check at steps
# trimesh's CollisionManager asks FCL at each step. It holds whole groups: the moving links and the obstacles, and for each
# set of links that may hit the same others, these and those. It gets the same triangles, from yourdfpy.
scene = yourdfpy.URDF.load(
    str(package["panda.urdf"]), build_scene_graph=False, build_collision_scene_graph=True, load_collision_meshes=True
).collision_scene
parents, graph = scene.graph.transforms.parents, scene.graph
meshes = {parents[node]: scene.geometry[graph[node][1]] for node in graph.nodes_geometry}
holders: dict[str, list[CollisionManager]] = {link: [] for link in meshes}


def manager(links: list[str]) -> CollisionManager:
    made = CollisionManager()
    for link in links:
        made.add_object(link, meshes[link])
        holders[link].append(made)
    return made


partners: dict[str, list[str]] = {link: [b for a, b in robot.checked_pairs if a == link] for link in meshes}
between = [(manager([link]), manager(others)) for link, others in partners.items() if others]
moving = manager([link for link in meshes if link != "panda_link0"])
standing = CollisionManager()
for name, (mesh, pose) in obstacles.items():
    standing.add_object(name, mesh)
    standing.set_transform(name, pose)  # in 64-bit numbers, which add_object would round to 32


def place(at: np.ndarray) -> None:
    for link, managers in holders.items():
        pose = robot.pose(link, at)
        for each in managers:
            each.set_transform(link, pose)


def collides(at: np.ndarray) -> bool:
    place(at)
    return moving.in_collision_other(standing) or any(low.in_collision_other(high) for low, high in between)


def first_step(start: np.ndarray, end: np.ndarray, steps: int) -> float | None:
    """Returns the share of the edge at the first step at which FCL finds a collision."""
    return next((t for t in np.linspace(0, 1, steps + 1) if collides(start + t * (end - start))), None)


# %% Edges
# An edge begins where FCL finds the arm free, and turns each joint by up to 1.5 radians.
starts, ends = np.empty((2, 0, len(LOW)))
while len(starts) < EDGES:
    start = random.uniform(LOW, HIGH)
    if not collides(start):
        starts = np.vstack([starts, start])
        ends = np.vstack([ends, np.clip(start + random.uniform(-1.5, 1.5, len(start)), LOW, HIGH)])


def timed(check: Callable[[], np.ndarray]) -> tuple[np.ndarray, float]:
    """Returns which edges are accepted, and the number of edges per second."""
    began = time.perf_counter()
    accepted = check()
    return accepted, EDGES / (time.perf_counter() - began)


answers = {"certified": timed(lambda: cell.edges(starts, ends, threads=1, tolerance=TOLERANCE)["status"] == "free")}
for steps in (5, 20, 100):
    answers[f"{steps} steps"] = timed(
        lambda steps=steps: np.array([first_step(*edge, steps) is None for edge in zip(starts, ends)])
    )
touches = [cell.first_contact(edge, tolerance=1e-6) for edge in zip(starts, ends)]
touching = np.array([touch is not None for touch in touches])
missed = {check: np.flatnonzero(accepted & touching) for check, (accepted, _) in answers.items()}
print(f"\n{EDGES} edges among {len(obstacles)} obstacles; {touching.sum()} edges touch")
print("check      accepted  of these touch  edges/s")
for check, (accepted, rate) in answers.items():
    print(f"{check:10} {accepted.sum():8} {len(missed[check]):15} {rate:8.0f}")


# %% Are these contacts real, and are the proofs?
# FCL and trimesh judge. They know nothing of our answers.
def off_surface(thing: str, at: np.ndarray, point: ArrayLike) -> float:
    """Returns the distance of a point from the surface of a link or an obstacle."""
    mesh, pose = (meshes[thing], robot.pose(thing, at)) if thing in meshes else obstacles[thing]
    local = trimesh.transform_points([point], np.linalg.inv(pose))
    return trimesh.proximity.closest_point_naive(mesh, local)[1][0]


for start, end, touch, free in zip(starts, ends, touches, answers["certified"][0]):
    seen = first_step(start, end, 200)
    # A certified edge has no collision at 200 steps, and any collision is after our first contact.
    assert not (free and (touch or seen is not None))
    assert seen is None or (touch is not None and touch.share <= seen), (seen, touch)
    # Every refused edge has two bodies that come nearer than the tolerance.
    if not free and touch is None:
        assert cell.closest_approach([start, end], tolerance=1e-6).upper <= TOLERANCE + 1e-6
    if touch is not None:
        # The witnesses are a micrometre apart, on both surfaces.
        at = start + touch.share * (end - start)
        assert np.linalg.norm(np.subtract(touch.witness_a, touch.witness_b)) < 1e-6 + ROUNDING
        assert off_surface(touch.a, at, touch.witness_a) < ROUNDING, touch
        assert off_surface(touch.b, at, touch.witness_b) < ROUNDING, touch

# Each edge that steps accept wrongly: FCL finds the collision too, when it looks soon after our first contact.
assert len(missed["5 steps"]) and not len(missed["certified"])
for k in sorted(set().union(*missed.values())):
    after = touches[k].share + np.geomspace(1e-6, 1e-2, 60)
    assert any(collides(starts[k] + t * (ends[k] - starts[k])) for t in after[after <= 1]), k
k = max(missed["5 steps"], key=lambda k: k in missed["20 steps"])
finest = [check for check in missed if k in missed[check]][-1]
print(f"Edge {k}, accepted at {finest}: {touches[k].a} meets {touches[k].b} at {touches[k].share:.4f} of it")

# %% A whole turn of the base
# Joint 1 goes through its travel in stretches. `closest_approach` gives what the clearance never falls below in a stretch,
# between steps too. The dots are distances at 41 equal steps, by FCL.


def turned_to(angle: float) -> np.ndarray:
    return np.array([angle, 0.0, 0.6, -2.6, 1.1, 3.7, 1.6, 0.02])


def their_distance(angle: float) -> float:
    place(turned_to(angle))
    return min(moving.min_distance_other(standing), *(low.min_distance_other(high) for low, high in between))


angles = np.linspace(LOW[0], HIGH[0], 241)
found = [cell.closest_approach([turned_to(a), turned_to(b)], tolerance=TOLERANCE) for a, b in pairwise(angles)]
lower, upper = np.array([(each.lower, each.upper) for each in found]).T
stops = np.linspace(LOW[0], HIGH[0], 41)
dots = np.array([their_distance(angle) for angle in stops])
# No distance of FCL is under the bound of a stretch it belongs to: not at the dots, and not at ten times as many.
finer = np.linspace(LOW[0], HIGH[0], 401)
stretch = np.clip(np.searchsorted(angles, finer) - 1, 0, len(lower) - 1)
assert np.all(np.array([their_distance(angle) for angle in finer]) >= lower[stretch] - ROUNDING)
# The least of it all is real: at our place, FCL says the same.
k = int(np.argmin(upper))
nearest = angles[k] + found[k].nearest.share * (angles[k + 1] - angles[k])
assert abs(max(their_distance(nearest), 0) - upper[k]) < TOLERANCE + ROUNDING, (their_distance(nearest), upper[k])
proven, sampled = 1e3 * lower.min(), 1e3 * dots.min()
print(f"\nLeast clearance over a turn of the base: {proven:.1f} mm, proven; {sampled:.1f} mm at 41 steps")
# %% The plot
figure = Figure(figsize=(9, 4.5), layout="constrained")  # draws with Agg: no window
axes = figure.subplots()
degrees, blue, red = np.degrees(angles), "#2a6fbb", "#d1495b"
axes.stairs(1e3 * lower, degrees, fill=True, color=blue, alpha=0.15)
axes.stairs(1e3 * lower, degrees, baseline=None, color=blue, label="certified: never nearer in each stretch")
axes.plot(np.degrees(stops), 1e3 * dots, "o", color=red, markersize=4, clip_on=False, label="FCL: distance at 41 steps")
axes.annotate(
    f"{1e3 * upper[k]:.1f} mm at {np.degrees(nearest):.1f}°,\nbetween two steps",
    xy=(np.degrees(nearest), 1e3 * upper[k]),
    xytext=(np.degrees(nearest) - 45, 15),
    ha="center",
    arrowprops={"arrowstyle": "->", "color": "0.3", "shrinkB": 0},
)
axes.set(xlim=degrees[[0, -1]], ylim=(0, None))
axes.set(xlabel="angle of joint 1 (degrees)", ylabel="clearance to obstacles (mm)")
axes.set_title("A Panda turns about its base", loc="left")
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False, loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0, ncols=2)
picture = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(tempfile.mkdtemp()) / "robot.png"
figure.savefig(picture, dpi=150)
print(f"Plot: {picture}")

# %% At rest
# Distances agree wherever nothing touches, and so do the verdicts.
print("\nFCL collides  FCL distance (m)  our distance (m)")
for at in random.uniform(LOW, HIGH, (12, len(LOW))):
    hits = collides(at)
    theirs = min(moving.min_distance_other(standing), *(low.min_distance_other(high) for low, high in between))
    ours = cell.closest_approach(at, tolerance=1e-6)
    print(f"{hits!s:>12} {theirs:17.6f}  {ours.lower:.6f} to {ours.upper:.6f}")
    assert hits == (ours.upper < 1e-9)
    assert hits or ours.lower - ROUNDING <= theirs <= ours.upper + ROUNDING
