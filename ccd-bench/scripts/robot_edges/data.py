"""Reads a folder of edges: a robot, cells around it, pairs of configurations, and whether they touch.

The folder has NAME.urdf and NAME.srdf, and for each cell, such as A: A.txt with a body in each line (`box` and half
extents, `sphere` and radius, `capsule` with radius and half length, or `mesh` and the name of an OBJ file), then its
pose as x y z and a quaternion w x y z; edges_A_LENGTH.bin with pairs of configurations of float64; and
truth_A_LENGTH.txt, whose lines begin with 1 for an edge that touches. chunks_A.bin has paths of 50 configurations.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
CHUNK = 50  # configurations of a path


@dataclass(frozen=True)
class Obstacle:
    """A body of a cell: `sizes` of a shape, or `mesh`, whose vertices are in its frame."""

    kind: str
    sizes: list[float]
    mesh: Path | None
    position: list[float]
    quaternion: list[float]  # w x y z

    @property
    def transform(self) -> Floats:
        """Its pose as a matrix of 4 by 4."""
        w, x, y, z = np.array(self.quaternion) / np.linalg.norm(self.quaternion)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        pose = np.eye(4)
        pose[:3, :3] += 2 * (w * cross + cross @ cross)
        pose[:3, 3] = self.position
        return pose

    def shape(self, library: Any, mesh: Callable[[Path], Any]) -> Any:
        """Returns it as a class of a library whose sizes are whole ones, or the mesh made of its file."""
        if self.mesh:
            return mesh(self.mesh)
        match self.kind, self.sizes:
            case "capsule", [radius, half_height]:
                return library.Capsule(radius, 2 * half_height)
            case "sphere", [radius]:
                return library.Sphere(radius)
        return library.Box(*[2 * size for size in self.sizes])


@dataclass(frozen=True)
class Cell:
    """The obstacles around the robot."""

    name: str
    obstacles: list[Obstacle]


@dataclass(frozen=True)
class Robot:
    """A robot of one mesh for each link, in the link's frame; most peers take the hull of it."""

    urdf: Path
    srdf: Path
    meshes: dict[str, Path]  # of each link
    base: str  # the link that does not move, which is not checked against obstacles
    joints: int

    @property
    def ignored(self) -> list[tuple[str, str]]:
        """Pairs of links that are not checked."""
        rules = ElementTree.parse(self.srdf).iter("disable_collisions")
        disabled = {frozenset((rule.attrib["link1"], rule.attrib["link2"])) for rule in rules}
        return [pair for pair in combinations(self.meshes, 2) if frozenset(pair) in disabled]

    @property
    def checked(self) -> list[tuple[str, str]]:
        """All other pairs of links."""
        ignored = set(self.ignored)
        return [pair for pair in combinations(self.meshes, 2) if pair not in ignored]


@dataclass(frozen=True)
class Edges:
    """Edges of one cell that turn the joints by `radians` together; `pairs` is (edges, 2, joints)."""

    cell: Cell
    radians: float
    pairs: Floats
    touches: Bools


def read_robot(folder: Path) -> Robot:
    urdf = next(folder.glob("*.urdf"))
    tree = ElementTree.parse(urdf)
    meshes = {link.attrib["name"]: link.find("collision/geometry/mesh") for link in tree.iter("link")}
    assert tree.find("link/collision/origin") is None, "meshes are in the frames of their links"
    files = {name: urdf.parent / mesh.attrib["filename"] for name, mesh in meshes.items() if mesh is not None}
    children = {child.attrib["link"] for child in tree.iterfind("joint/child")}
    moving = sum(joint.attrib["type"] != "fixed" for joint in tree.iterfind("joint"))
    return Robot(urdf, urdf.with_suffix(".srdf"), files, next(n for n in files if n not in children), moving)


def read_cell(cell: Path, folders: list[Path]) -> Cell:
    """Reads a cell, with its meshes from the first folder that has them."""
    obstacles = []
    for line in cell.read_text().splitlines():
        kind, *words = line.split()
        sizes, pose = words[:-7], [float(word) for word in words[-7:]]
        mesh = None
        if kind == "mesh":
            file = f"{sizes.pop()}.obj"
            mesh = next(folder / file for folder in folders if (folder / file).exists())
        obstacles.append(Obstacle(kind, [float(size) for size in sizes], mesh, pose[:3], pose[3:]))
    return Cell(cell.stem, obstacles)


def read_paths(file: Path, joints: int, count: int) -> Floats:
    """Reads paths of `count` configurations; joints that the file leaves out are at 0."""
    numbers = np.fromfile(file)
    given = joints if numbers.size % (count * joints) == 0 else joints - 1
    paths = numbers.reshape(-1, count, given)
    return np.concatenate([paths, np.zeros((*paths.shape[:2], joints - given))], axis=2)


def read_edges(folder: Path, robot: Robot, cell: Cell, most: int | None) -> Iterator[Edges]:
    """Reads the edges of a cell, of each file the first `most`."""
    for file in sorted(folder.glob(f"edges_{cell.name}_*.bin")):
        truth = file.with_name(file.stem.replace("edges", "truth") + ".txt").read_text().splitlines()
        touches = np.array([line.startswith("1") for line in truth])
        pairs = read_paths(file, robot.joints, 2)
        yield Edges(cell, float(file.stem.split("_")[2]), pairs[:most], touches[:most])


def read_mesh(file: Path) -> tuple[Floats, NDArray[np.int64]]:
    """Reads vertices and triangles of an OBJ file that has nothing else."""
    lines = [line.split() for line in file.read_text().splitlines()]
    vertices = np.array([line[1:4] for line in lines if line[:1] == ["v"]], dtype=float)
    triangles = [[int(word.split("/")[0]) - 1 for word in line[1:4]] for line in lines if line[:1] == ["f"]]
    return vertices, np.array(triangles, dtype=np.int64)
