"""Edges of a planner for a Franka Panda: certified, beside checks at equal steps.

    pip install example-robot-data yourdfpy trimesh python-fcl matplotlib
    python robot.py [PLOT.png]

The cells run in order, as a script or in an editor that knows `# %%`. Lengths are in metres, angles in radians.
"""

# %% Packages
# yourdfpy reads the robot, trimesh holds its meshes. trimesh's CollisionManager asks FCL: it is the check at steps.
import sys
import tempfile
import time
from dataclasses import dataclass
from importlib.metadata import files
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import matplotlib
import numpy as np
import trimesh
import yourdfpy
from trimesh.collision import CollisionManager

from rigid_ccd import Body, Chain, Joint, Motion, closest_approach, distance, first_contact, is_free

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

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
meshes = {scene.graph.transforms.parents[node]: scene.geometry[scene.graph[node][1]] for node in scene.graph.nodes_geometry}
ignored = {
    frozenset((pair.get("link1"), pair.get("link2")))
    for pair in ElementTree.parse(package["panda.srdf"]).iter("disable_collisions")
}


# %% Chains
# A chain is serial, so the hand's two fingers get one each. Both have ten joints: seven that turn, two that are fixed,
# and a finger's slide. The fingers move alike, and share the last position.
def joints_to(tip: str) -> list[yourdfpy.Joint]:
    """The joints from the robot's base to a link."""
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

LIMITS = np.array([(joint.limit.lower, joint.limit.upper) if joint.limit else (0, 0) for joint in joints])
print(f"{robot.robot.name}: {len(joints)} joints, {len(links)} bodies, {sum(len(k.others) for k in links)} pairs of links")
for link in links:
    print(f"  {link.name:18} {link.body.report}")

# Our poses are those of yourdfpy.
random = np.random.default_rng(4)
for _ in range(20):
    at = random.uniform(*LIMITS.T)
    robot.update_cfg({joint.name: x for joint, x in zip(joints, at)} | {"panda_finger_joint1": at[-1]})
    for link in links:
        theirs = robot.get_transform(link.name, collision_geometry=True)
        assert np.allclose(link.chain.pose(link.index, at), theirs, atol=1e-9), link.name


# %% The cell around it
# Boards, a post, a ball, and cables of 6 mm. Both checkers get the same triangles.
@dataclass
class Obstacle:
    shape: trimesh.Trimesh
    body: Body
    rests: Motion
    pose: np.ndarray


def stands(shape: trimesh.Trimesh, at: list[float], turned: np.ndarray | None = None) -> Obstacle:
    pose = np.eye(4) if turned is None else turned.copy()
    pose[:3, 3] = at
    return Obstacle(shape, Body.from_trimesh(shape), Motion(at, pose[:3, :3]), pose)


box = trimesh.creation.box
obstacles = {
    "table": stands(box((1.6, 1.6, 0.04)), [0, 0, -0.05]),
    "shelf": stands(box((0.4, 0.3, 0.015)), [0.45, 0.40, 0.60]),
    "guard": stands(box((0.6, 0.002, 0.5)), [0, -0.60, 0.30]),
    "post": stands(box((0.03, 0.03, 1.0)), [-0.35, 0.45, 0.50]),
    "ball": stands(trimesh.creation.icosphere(radius=0.08), [-0.50, -0.20, 0.60]),
}
while len(obstacles) < 17:
    at = random.uniform([-0.8, -0.8, 0], [0.8, 0.8, 1.1])
    if np.hypot(*at[:2]) > 0.3:  # not in the robot's trunk
        turned = trimesh.transformations.random_rotation_matrix(random.random(3))
        obstacles[f"cable {len(obstacles) - 4}"] = stands(box((0.006, 0.006, 0.3)), at, turned)


# %% Two checks of an edge
# An edge moves all joints at constant rates. Ours is asked once for each pair of bodies, for the whole edge. A pair of
# links is asked as the nearer one sees the other: what moves both costs nothing.
def pairs(start: np.ndarray, end: np.ndarray):
    """Each pair of bodies that may meet, with their motions: what the queries take."""
    for link in links:
        moves = link.chain.link(link.index, start, end)
        if link.index > 0:
            for obstacle in obstacles.values():
                yield link, obstacle, (link.body, obstacle.body, moves, obstacle.rests)
        for other in link.others:
            yield link, other, (link.body, other.body, moves.seen_from(other.index), None)


def edge_is_free(start: np.ndarray, end: np.ndarray) -> bool:
    return all(is_free(*asked, tolerance=TOLERANCE) for _, _, asked in pairs(start, end))


# FCL is asked at each step. Its managers hold whole groups, which is its fastest way: the moving links and the
# obstacles, and for each set of links that may hit the same others, these and those.
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
for name, obstacle in obstacles.items():
    standing.add_object(name, obstacle.shape)
    standing.set_transform(name, obstacle.pose)  # in 64-bit numbers, which add_object would round to 32


def place(at: np.ndarray) -> None:
    """Puts FCL's links where our chains say."""
    for link in links:
        pose = link.chain.pose(link.index, at)
        for holder in holders[link.name]:
            holder.set_transform(link.name, pose)


def collides(at: np.ndarray) -> bool:
    place(at)
    return moving.in_collision_other(standing) or any(low.in_collision_other(high) for low, high in between)


def first_step(start: np.ndarray, end: np.ndarray, steps: int) -> float | None:
    """The time of the first of equal steps at which FCL finds a collision."""
    return next((t for t in np.linspace(0, 1, steps + 1) if collides(start + t * (end - start))), None)


# %% Edges
# An edge begins where FCL finds the arm free, and turns each joint by up to 1.5 radians.
def draw(count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    edges = []
    while len(edges) < count:
        start = random.uniform(*LIMITS.T)
        end = np.clip(start + random.uniform(-1.5, 1.5, len(start)), *LIMITS.T)
        if not collides(start):
            edges.append((start, end))
    return edges


@dataclass
class Touch:
    """The first contact of an edge, and the two things in contact."""

    time: float
    link: Link
    other: Link | Obstacle
    points: np.ndarray


def first_touch(start: np.ndarray, end: np.ndarray) -> Touch | None:
    """The first contact of all pairs. Each pair is asked only up to the first contact so far."""
    first, until = None, 1.0
    for link, other, asked in pairs(start, end):
        if until > 0 and (hit := first_contact(*asked, duration=until, tolerance=1e-6)):
            until, first = hit.time, Touch(hit.time, link, other, np.array([hit.witness_a, hit.witness_b]))
    return first


def timed(check) -> tuple[list, float]:
    """The answer for each edge, and edges per second."""
    began = time.perf_counter()
    found = [check(*edge) for edge in edges]
    return found, len(edges) / (time.perf_counter() - began)


edges = draw(EDGES)
touches, _ = timed(first_touch)
answers = {"certified": timed(edge_is_free)}
for steps in (5, 20, 100):
    answers[f"{steps} steps"] = timed(lambda *edge: first_step(*edge, steps) is None)
missed = {check: [k for k, free in enumerate(found) if free and touches[k]] for check, (found, _) in answers.items()}

print(f"\n{EDGES} edges among {len(obstacles)} obstacles, {sum(touch is not None for touch in touches)} of them touch")
print("check      accepted  of these touch  edges/s")
for check, (found, rate) in answers.items():
    print(f"{check:10} {sum(found):8} {len(missed[check]):15} {rate:8.0f}")


# %% Are these contacts real, and are the proofs?
# FCL and trimesh judge. They know nothing of our answers.
def off_surface(thing: Link | Obstacle, pose: np.ndarray, point: np.ndarray) -> float:
    """How far a point is from the surface of a mesh at a pose."""
    local = np.linalg.inv(pose) @ [*point, 1]
    mesh = thing.mesh if isinstance(thing, Link) else thing.shape
    return trimesh.proximity.closest_point_naive(mesh, [local[:3]])[1][0]


for (start, end), touch, free in zip(edges, touches, answers["certified"][0]):
    seen = first_step(start, end, 200)
    # What is certified never collides at 200 steps, and what collides does so after our time of contact.
    assert not (free and (touch or seen is not None))
    if touch is None:
        assert seen is None
        continue
    assert seen is None or touch.time <= seen, (touch.time, seen)
    # The witnesses are a micrometre apart, on both surfaces.
    at = start + touch.time * (end - start)
    pose = touch.link.chain.pose(touch.link.index, at)
    if isinstance(touch.other, Link):  # seen from the other link, which rests in its own frame
        pose = np.linalg.inv(touch.other.chain.pose(touch.other.index, at)) @ pose
    stands_at = touch.other.pose if isinstance(touch.other, Obstacle) else np.eye(4)
    assert np.linalg.norm(np.subtract(*touch.points)) < 1e-6 + ROUNDING
    assert off_surface(touch.link, pose, touch.points[0]) < ROUNDING
    assert off_surface(touch.other, stands_at, touch.points[1]) < ROUNDING

# Each edge that steps accept wrongly: FCL finds the collision too, when it looks soon after our time of contact.
assert missed["5 steps"] and not missed["certified"]
for k in set().union(*missed.values()):
    (start, end), touch = edges[k], touches[k]
    after = touch.time + np.geomspace(1e-6, 1e-2, 60)
    assert any(collides(start + t * (end - start)) for t in after[after <= 1]), k
k = max(missed["5 steps"], key=lambda k: k in missed["20 steps"])
touch = touches[k]
names = [name for name, obstacle in obstacles.items() if obstacle is touch.other] or [touch.other.name]
print(f"Edge {k}, which steps accept: {touch.link.name} touches {names[0]} at time {touch.time:.4f}", touch.points[1].round(3))
