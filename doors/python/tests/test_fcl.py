"""Compares the answers of examples/robot.py with FCL and trimesh, which are independent of this package."""

import runpy
import sys
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

trimesh, yourdfpy = (pytest.importorskip(name) for name in ("trimesh", "yourdfpy"))
for name in ("fcl", "matplotlib"):
    pytest.importorskip(name)
try:
    distribution("example-robot-data")  # files alone, and no module
except PackageNotFoundError:
    pytest.skip("needs example-robot-data", allow_module_level=True)

ROUNDING = 1e-5  # FCL stops within 1e-6 of a distance; STL files hold 32-bit numbers
EXAMPLE = Path(__file__).parents[1] / "examples/robot.py"


class Judge:
    """FCL's managers of the same triangles: of moving links, of obstacles, and of the links that each link may meet."""

    def __init__(self, example: Any) -> None:
        self.robot = example.robot
        urdf = yourdfpy.URDF.load(str(example.package["panda.urdf"]), build_scene_graph=False,
                                  build_collision_scene_graph=True, load_collision_meshes=True)  # fmt: skip
        scene, graph = urdf.collision_scene, urdf.collision_scene.graph
        self.links = {graph.transforms.parents[node]: scene.geometry[graph[node][1]] for node in graph.nodes_geometry}
        self.obstacles = {}
        for name, (size, position, rotation) in example.boxes.items():
            pose = trimesh.transformations.quaternion_matrix(np.roll(rotation, 1))  # w first
            pose[:3, 3] = position
            self.obstacles[name] = trimesh.creation.box(size), pose
        self.held: list[tuple[str, Any]] = []
        self.moving = self.manager([link for link in self.links if link != "panda_link0"])
        partners = {link: [b for a, b in self.robot.checked_pairs if a == link] for link in self.links}
        self.pairs = [(self.manager([link]), self.manager(others)) for link, others in partners.items() if others]
        self.standing = trimesh.collision.CollisionManager()
        for name, (mesh, pose) in self.obstacles.items():
            self.standing.add_object(name, mesh)
            self.standing.set_transform(name, pose)  # in 64-bit numbers, which add_object would round to 32

    def manager(self, links: list[str]) -> Any:
        made = trimesh.collision.CollisionManager()
        for link in links:
            made.add_object(link, self.links[link])
            self.held.append((link, made))
        return made

    def place(self, at: ArrayLike) -> None:
        poses = {link: self.robot.pose(link, at) for link in self.links}
        for link, manager in self.held:
            manager.set_transform(link, poses[link])

    def collides(self, at: ArrayLike) -> bool:
        self.place(at)
        return bool(
            self.moving.in_collision_other(self.standing) or any(a.in_collision_other(b) for a, b in self.pairs)
        )

    def distance(self, at: ArrayLike) -> float:
        self.place(at)
        of_pairs = [a.min_distance_other(b) for a, b in self.pairs]
        return float(max(0, min(self.moving.min_distance_other(self.standing), *of_pairs)))

    def off_surface(self, thing: str, at: ArrayLike, point: ArrayLike) -> float:
        """Returns the distance of a point from the surface of a link or an obstacle."""
        mesh, pose = (self.links[thing], self.robot.pose(thing, at)) if thing in self.links else self.obstacles[thing]
        local = trimesh.transform_points([point], np.linalg.inv(pose))
        return float(trimesh.proximity.closest_point_naive(mesh, local)[1][0])


@pytest.fixture(scope="module")
def example(tmp_path_factory: pytest.TempPathFactory) -> Any:
    plot = tmp_path_factory.mktemp("plot") / "robot.png"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", [str(EXAMPLE), str(plot)])
        ran = SimpleNamespace(**runpy.run_path(str(EXAMPLE)))
    assert plot.stat().st_size > 10_000
    return ran


@pytest.fixture(scope="module")
def judge(example: Any) -> Judge:
    return Judge(example)


@pytest.fixture(scope="module")
def contacts(example: Any) -> list[Any]:
    return [example.cell.first_contact(edge, tolerance=1e-6) for edge in zip(example.starts, example.ends, strict=True)]


def along(example: Any, edge: int, fractions: NDArray[np.float64]) -> Any:
    return example.starts[edge] + fractions[:, None] * (example.ends[edge] - example.starts[edge])


def test_no_collision_is_on_a_certified_edge_or_before_a_contact(
    example: Any, judge: Judge, contacts: list[Any]
) -> None:
    fractions = np.linspace(0, 1, 101)
    for edge, contact in enumerate(contacts):
        assert not (example.certified[edge] and contact)
        until = 1 if contact is None else contact.fraction
        assert not any(judge.collides(at) for at in along(example, edge, fractions[fractions < until])), edge


def test_each_refused_edge_comes_nearer_than_the_tolerance(example: Any, contacts: list[Any]) -> None:
    for edge in np.flatnonzero(~example.certified):
        if contacts[edge] is None:
            nearest = example.cell.closest_approach([example.starts[edge], example.ends[edge]], tolerance=1e-6)
            assert nearest.upper <= example.TOLERANCE + 1e-6


def test_witnesses_are_on_both_surfaces(example: Any, judge: Judge, contacts: list[Any]) -> None:
    for edge, contact in enumerate(contacts):
        if contact is not None:
            at = along(example, edge, np.array([contact.fraction]))[0]
            assert np.linalg.norm(np.subtract(contact.witness_a, contact.witness_b)) < 1e-6 + ROUNDING
            assert judge.off_surface(contact.a, at, contact.witness_a) < ROUNDING, contact
            assert judge.off_surface(contact.b, at, contact.witness_b) < ROUNDING, contact


def test_edges_that_five_steps_accept_collide_soon_after_the_contact(
    example: Any, judge: Judge, contacts: list[Any]
) -> None:
    touching = [edge for edge, contact in enumerate(contacts) if contact is not None]
    missed = [edge for edge in touching if not any(map(judge.collides, along(example, edge, np.linspace(0, 1, 6))))]
    assert len(missed) > 5
    for edge in missed:
        after = contacts[edge].fraction + np.geomspace(1e-6, 1e-2, 60)
        assert any(judge.collides(at) for at in along(example, edge, after[after <= 1])), edge


def test_no_distance_on_the_turn_is_under_its_bound(example: Any, judge: Judge) -> None:
    fractions = np.linspace(0, 1, 401)
    angles = example.low[0] + fractions * (example.high[0] - example.low[0])
    stretch = np.clip(np.searchsorted(example.angles, angles) - 1, 0, len(example.lower) - 1)
    distances = 1e3 * np.array([judge.distance([angle, *example.POSE]) for angle in angles])
    assert (distances >= example.lower[stretch] - 1e3 * ROUNDING).all()
    # The smallest lower bound is attained, up to the tolerance.
    least = int(example.lower.argmin())
    near = np.linspace(example.angles[least], example.angles[least + 1], 100)
    nearest = 1e3 * min(judge.distance([angle, *example.POSE]) for angle in near)
    assert nearest <= example.lower[least] + 1e3 * (example.TOLERANCE + ROUNDING)


def test_distances_at_rest_agree(example: Any, judge: Judge) -> None:
    rng = np.random.default_rng(1)
    for at in rng.uniform(example.low, example.high, (30, len(example.low))):
        ours, theirs = example.cell.closest_approach(at, tolerance=1e-6), judge.distance(at)
        assert judge.collides(at) == (ours.upper < 1e-9)
        assert ours.lower - ROUNDING <= theirs <= ours.upper + ROUNDING
