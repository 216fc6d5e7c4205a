"""Edges of a planner for a Franka Panda: certified, and compared with checks at equal steps.

    pip install example-robot-data yourdfpy trimesh python-fcl matplotlib
    python robot.py [PLOT.png]

The cells run in order, as a script or in an editor that knows `# %%`. Lengths are in metres, angles in radians.
"""

# %% Packages
# yourdfpy reads the robot, trimesh holds its meshes. trimesh's CollisionManager asks FCL: it is the check at steps.
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.metadata import files
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import trimesh
import yourdfpy
from matplotlib.figure import Figure
from numpy.typing import ArrayLike
from trimesh.collision import CollisionManager

from rigid_ccd import Body, Chain, Joint, Motion, closest_approach, distance, first_contact, is_free

EDGES = 400
TOLERANCE = 1e-4  # an edge that keeps this much clearance is certified
ROUNDING = 1e-5  # FCL stops within 1e-6 of a distance; STL files hold 32-bit numbers

# %% The robot
# The wheel of example-robot-data carries URDF, SRDF and meshes. The SRDF lists the pairs of links that need no check:
# neighbours, and pairs that never meet.
package = {path.name: path.locate() for path in files("example-robot-data") or []}
robot = yourdfpy.URDF.load(
    str(package["panda.urdf"]), build_scene_graph=False, build_collision_scene_graph=True, load_collision_meshes=True
)
scene = robot.collision_scene
graph = scene.graph
meshes = {graph.transforms.parents[node]: scene.geometry[graph[node][1]] for node in graph.nodes_geometry}
ignored = {
    frozenset((pair.get("link1"), pair.get("link2")))
    for pair in ElementTree.parse(package["panda.srdf"]).iter("disable_collisions")
}


# %% Chains
# A chain is serial, so the hand's two fingers get one each. Both have ten joints: seven that turn, two that are fixed,
# and a finger's slide. The fingers move alike, and share the last position.
def joints_to(tip: str) -> list[yourdfpy.Joint]:
    """Returns the joints from the robot's base to a link."""
    above = {joint.child: joint for joint in robot.robot.joints}
    found = []
    while tip in above:
        found.append(above[tip])
        tip = above[tip].parent
    return found[::-1]


def chain_of(joints: list[yourdfpy.Joint]) -> Chain:
    made = []
    for joint in joints:
        match joint.type:
            case "revolute":
                made.append(Joint.revolute(joint.origin, joint.axis, limits=(joint.limit.lower, joint.limit.upper)))
            case "prismatic":
                made.append(Joint.prismatic(joint.origin, joint.axis, limits=(joint.limit.lower, joint.limit.upper)))
            case "fixed":
                made.append(Joint.fixed(joint.origin))
            case other:
                raise NotImplementedError(f"{joint.name}: a joint of type {other}")
    return Chain(made)


@dataclass
class Link:
    """A link with its body; `others` are the links nearer to the base that it may hit."""

    name: str
    mesh: trimesh.Trimesh
    body: Body
    chain: Chain
    index: int
    others: list["Link"]

    def pose(self, at: np.ndarray) -> np.ndarray:
        return self.chain.pose(self.index, at)


links: list[Link] = []
for tip in ("panda_leftfinger", "panda_rightfinger"):
    joints = joints_to(tip)
    chain = chain_of(joints)
    for index, name in enumerate([robot.base_link, *(joint.child for joint in joints)]):
        if name in meshes and all(link.name != name for link in links):
            links.append(Link(name, meshes[name], Body.from_trimesh(meshes[name]), chain, index, []))
for low, high in combinations(links, 2):
    if frozenset((low.name, high.name)) not in ignored:
        high.others.append(low)

LOW = np.array([joint.limit.lower if joint.limit else 0.0 for joint in joints])
HIGH = np.array([joint.limit.upper if joint.limit else 0.0 for joint in joints])
between_links = sum(len(link.others) for link in links)
print(f"{robot.robot.name}: {len(links)} bodies, {between_links} pairs of them to check")
assert all(link.body.is_solid for link in links)

# Our poses are those of yourdfpy.
random = np.random.default_rng(4)
for _ in range(20):
    at = random.uniform(LOW, HIGH)
    robot.update_cfg({joint.name: x for joint, x in zip(joints, at)} | {"panda_finger_joint1": at[-1]})
    for link in links:
        theirs = robot.get_transform(link.name, collision_geometry=True)
        assert np.allclose(link.pose(at), theirs, atol=1e-9), link.name


# %% The cell around it
# Boards, a post, a ball, and cables of 6 mm. Both checkers get the same triangles.
@dataclass
class Obstacle:
    name: str
    mesh: trimesh.Trimesh
    body: Body
    stands: np.ndarray
    rests: Motion

    def pose(self, _at: np.ndarray) -> np.ndarray:
        return self.stands


def obstacle_of(name: str, mesh: trimesh.Trimesh, at: ArrayLike, turned: np.ndarray | None = None) -> Obstacle:
    pose = np.eye(4) if turned is None else turned.copy()
    pose[:3, 3] = at
    return Obstacle(name, mesh, Body.from_trimesh(mesh), pose, Motion.still(pose))


box, ball = trimesh.creation.box, trimesh.creation.icosphere
obstacles = [
    obstacle_of("table", box((1.6, 1.6, 0.04)), [0, 0, -0.05]),
    obstacle_of("shelf", box((0.4, 0.3, 0.015)), [0.45, 0.40, 0.60]),
    obstacle_of("guard", box((0.6, 0.002, 0.5)), [0, -0.60, 0.30]),
    obstacle_of("post", box((0.03, 0.03, 1.0)), [-0.35, 0.45, 0.50]),
    obstacle_of("ball", ball(radius=0.08), [-0.50, -0.20, 0.60]),
]
while len(obstacles) < 17:
    at = random.uniform([-0.8, -0.8, 0], [0.8, 0.8, 1.1])
    if np.hypot(*at[:2]) > 0.3:  # not in the robot's trunk
        turned = trimesh.transformations.random_rotation_matrix(random.random(3))
        obstacles.append(obstacle_of(f"cable {len(obstacles) - 4}", box((0.006, 0.006, 0.3)), at, turned))
# A single body is fastest if it does not matter which obstacle is hit.
placed = [obstacle.mesh.copy().apply_transform(obstacle.stands) for obstacle in obstacles]
cell = obstacle_of("cell", trimesh.util.concatenate(placed), [0, 0, 0])


# %% Two checks of an edge
# An edge moves each joint from one position to another. Ours is asked once for each pair of bodies, for the whole edge.
# A pair of links is asked as the nearer one sees the other: what moves both costs nothing.
def pairs(start: np.ndarray, end: np.ndarray, around: list[Obstacle]) -> Iterator[tuple[Link, Link | Obstacle, Any]]:
    """Returns each pair of bodies that may meet, with their motions, as arguments of queries."""
    for link in links:
        moves = link.chain.link(link.index, start, end)
        if link.index > 0:
            for obstacle in around:
                yield link, obstacle, (link.body, obstacle.body, moves, obstacle.rests)
        for other in link.others:
            yield link, other, (link.body, other.body, moves.seen_from(other.index), None)


def edge_is_free(start: np.ndarray, end: np.ndarray) -> bool:
    return all(is_free(*asked, tolerance=TOLERANCE) for _, _, asked in pairs(start, end, [cell]))


# FCL is asked at each step. Its managers hold whole groups, far faster than pairs by name: the moving links and the
# obstacles, and for each set of links that may hit the same others, these and those. Most of a step goes into placing.
holders: dict[str, list[CollisionManager]] = {link.name: [] for link in links}


def manager(names: list[str]) -> CollisionManager:
    made = CollisionManager()
    for name in names:
        made.add_object(name, meshes[name])
        holders[name].append(made)
    return made


groups: dict[tuple[str, ...], list[str]] = {}
for low in links:
    if higher := tuple(high.name for high in links if low in high.others):
        groups.setdefault(higher, []).append(low.name)
between = [(manager(lower), manager(list(higher))) for higher, lower in groups.items()]
moving = manager([link.name for link in links if link.index > 0])
standing = CollisionManager()
for obstacle in obstacles:
    standing.add_object(obstacle.name, obstacle.mesh)
    standing.set_transform(obstacle.name, obstacle.stands)  # in 64-bit numbers, which add_object would round to 32


def place(at: np.ndarray) -> None:
    """Sets the poses of FCL's links to those of our chains."""
    for link in links:
        pose = link.pose(at)
        for holder in holders[link.name]:
            holder.set_transform(link.name, pose)


def collides(at: np.ndarray) -> bool:
    place(at)
    return moving.in_collision_other(standing) or any(low.in_collision_other(high) for low, high in between)


def at_time(start: np.ndarray, end: np.ndarray, t: float) -> np.ndarray:
    """Returns the joint positions at a time from 0 to 1."""
    return start + t * (end - start)


def first_step(start: np.ndarray, end: np.ndarray, steps: int) -> float | None:
    """Returns the time of the first step at which FCL finds a collision."""
    return next((t for t in np.linspace(0, 1, steps + 1) if collides(at_time(start, end, t))), None)


# %% Edges
# An edge begins where FCL finds the arm free, and turns each joint by up to 1.5 radians.
def draw(count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    edges: list[tuple[np.ndarray, np.ndarray]] = []
    while len(edges) < count:
        start = random.uniform(LOW, HIGH)
        end = np.clip(start + random.uniform(-1.5, 1.5, len(start)), LOW, HIGH)
        if not collides(start):
            edges.append((start, end))
    return edges


@dataclass
class Touch:
    """The first contact of an edge: two bodies, and a point of each in the world."""

    time: float
    things: tuple[Link, Link | Obstacle]
    points: np.ndarray


def first_touch(start: np.ndarray, end: np.ndarray) -> Touch | None:
    """Returns the first contact of all pairs. Each query ends at the first contact so far."""
    first: Touch | None = None
    until = 1.0
    for link, other, asked in pairs(start, end, obstacles):
        if until > 0 and (hit := first_contact(*asked, duration=until, tolerance=1e-6)):
            points, until = np.array([hit.witness_a, hit.witness_b]), hit.time
            if isinstance(other, Link):  # the answer is in the frame of the link that sees
                points = trimesh.transform_points(points, other.pose(at_time(start, end, until)))
            first = Touch(until, (link, other), points)
    return first


def timed(check: Callable[..., Any]) -> tuple[list[Any], float]:
    """Returns the answer for each edge, and the number of edges per second."""
    began = time.perf_counter()
    found = [check(*edge) for edge in edges]
    return found, len(edges) / (time.perf_counter() - began)


edges = draw(EDGES)
touches, _ = timed(first_touch)
answers = {"certified": timed(edge_is_free)}
for steps in (5, 20, 100):
    answers[f"{steps} steps"] = timed(lambda start, end, steps=steps: first_step(start, end, steps) is None)
missed = {check: [k for k, free in enumerate(found) if free and touches[k]] for check, (found, _) in answers.items()}

touching = sum(touch is not None for touch in touches)
print(f"\n{len(edges)} edges among {len(obstacles)} obstacles; {touching} edges touch")
print("check      accepted  of these touch  edges/s")
for check, (found, rate) in answers.items():
    print(f"{check:10} {sum(found):8} {len(missed[check]):15} {rate:8.0f}")


# %% Are these contacts real, and are the proofs?
# FCL and trimesh judge. They know nothing of our answers.
def off_surface(mesh: trimesh.Trimesh, pose: np.ndarray, point: np.ndarray) -> float:
    """Returns the distance of a point from the surface of a mesh at a pose."""
    local = trimesh.transform_points([point], np.linalg.inv(pose))
    return trimesh.proximity.closest_point_naive(mesh, local)[1][0]


for (start, end), touch, free in zip(edges, touches, answers["certified"][0]):
    seen = first_step(start, end, 200)
    # A certified edge has no collision at 200 steps, and any collision is after our time of contact.
    assert not (free and (touch or seen is not None))
    assert seen is None or (touch is not None and touch.time <= seen), (seen, touch and touch.time)
    # Every refused edge has two bodies that come nearer than the tolerance.
    if not free and touch is None:
        nearest = min(closest_approach(*asked, tolerance=1e-6).upper for _, _, asked in pairs(start, end, [cell]))
        assert nearest <= TOLERANCE + 1e-6, nearest
    if touch is not None:
        # The witnesses are a micrometre apart, on both surfaces.
        at = at_time(start, end, touch.time)
        assert np.linalg.norm(np.subtract(*touch.points)) < 1e-6 + ROUNDING
        for thing, point in zip(touch.things, touch.points):
            assert off_surface(thing.mesh, thing.pose(at), point) < ROUNDING, thing.name

# Each edge that steps accept wrongly: FCL finds the collision too, when it looks soon after our time of contact.
assert missed["5 steps"] and not missed["certified"]
for k in sorted(set().union(*missed.values())):
    (start, end), touch = edges[k], touches[k]
    after = touch.time + np.geomspace(1e-6, 1e-2, 60)
    assert any(collides(at_time(start, end, t)) for t in after[after <= 1]), k
k = max(missed["5 steps"], key=lambda k: k in missed["20 steps"])
names, point = [thing.name for thing in touches[k].things], touches[k].points[1].round(3)
finest = max((check for check in missed if k in missed[check]), key=lambda check: int(check.split()[0]))
print(f"Edge {k}, accepted at {finest}: {names[0]} meets {names[1]} at time {touches[k].time:.4f}, at {point} m")


# %% A whole turn of the base
# Joint 1 goes through its travel in stretches. `closest_approach` of every moving link to every obstacle gives what the
# clearance never falls below in a stretch, between steps too. The dots are FCL's distances at 41 equal steps.
def clearance(start: np.ndarray, end: np.ndarray) -> tuple[float, float, float]:
    """Returns bounds of the least distance from the arm to the obstacles over an edge, and its time."""
    found = [
        closest_approach(*asked, tolerance=TOLERANCE) for _, other, asked in pairs(start, end, [cell]) if other is cell
    ]
    nearest = min(found, key=lambda each: each.upper)
    return max(min(each.lower for each in found), 0), nearest.upper, nearest.time


def turned_to(angle: float) -> np.ndarray:
    return np.array([angle, 0.0, 0.6, -2.6, 1.1, 3.7, 1.6, 0, 0, 0.02])


def their_distance(angle: float) -> float:
    place(turned_to(angle))
    return moving.min_distance_other(standing)


angles = np.linspace(LOW[0], HIGH[0], 241)
lower, upper, when = np.array([clearance(turned_to(a), turned_to(b)) for a, b in pairwise(angles)]).T
stops = np.linspace(LOW[0], HIGH[0], 41)
dots = np.array([their_distance(angle) for angle in stops])
# No distance of FCL is under the bound of a stretch it belongs to: not at the dots, and not at ten times as many.
finer = np.linspace(LOW[0], HIGH[0], 401)
stretch = np.clip(np.searchsorted(angles, finer) - 1, 0, len(lower) - 1)
assert np.all(np.array([their_distance(angle) for angle in finer]) >= lower[stretch] - ROUNDING)
# The least of it all is real: at our time, FCL says the same.
k = int(np.argmin(upper))
nearest = angles[k] + when[k] * (angles[k + 1] - angles[k])
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
    xytext=(np.degrees(nearest), 125),
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

# %% Ours beside trimesh's, at rest
# Distances agree wherever both are apart, and so do the verdicts.
print("\nFCL collides  FCL distance (m)  our distance (m)")
for at in random.uniform(LOW, HIGH, (12, len(LOW))):
    place(at)
    hits, theirs = moving.in_collision_other(standing), moving.min_distance_other(standing)
    found = [
        distance(link.body, cell.body, link.pose(at), cell.stands, tolerance=1e-6) for link in links if link.index > 0
    ]
    low, high = (min(getattr(each, bound) for each in found) for bound in ("lower", "upper"))
    print(f"{hits!s:>12} {theirs:17.6f}  {low:.6f} to {high:.6f}")
    assert hits == (high <= 0)
    assert hits or low - ROUNDING <= theirs <= high + ROUNDING

# For FCL a mesh is a surface. A bolt that stands wholly inside the hand does not collide with it; for us it does, since
# the mesh is closed and bounds a solid.
bolt, hand = trimesh.creation.icosphere(radius=0.005), meshes["panda_hand"]
inside = np.eye(4)
inside[:3, 3] = hand.center_mass
alone = CollisionManager()
alone.add_object("hand", hand)
inner = first_contact(Body.from_trimesh(bolt), Body.from_trimesh(hand), Motion(hand.center_mass))
print(f"A bolt inside the hand: FCL collides {alone.in_collision_single(bolt, inside)}, ours {inner and inner.kind}")
assert inner is not None and inner.kind == "overlapping"
assert not alone.in_collision_single(bolt, inside)
