"""Tesseract: Bullet's cast of hulls between two poses of each link, for stretches of an edge of 0.1 rad."""

import sysconfig
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pinocchio
from tesseract_robotics import tesseract_collision as collision
from tesseract_robotics import tesseract_common as common
from tesseract_robotics import tesseract_geometry as geometry

from data import Cell, Floats, Robot, read_mesh
from measure import Configuration, Measure, one_by_one

TITLE, VERSION = "Tesseract", version("tesseract-robotics")
STRETCH = 0.1  # radians
LIBRARIES = Path(sysconfig.get_path("platlib")) / "tesseract_robotics.libs"
MANAGER = "BulletCastBVHManager"
PLUGINS = """
contact_manager_plugins:
  search_paths: [{folder}]
  search_libraries: [{library}]
  continuous_plugins:
    default: {manager}
    plugins:
      {manager}:
        class: {manager}Factory
"""


def plugins() -> str:
    library = next(LIBRARIES.glob("libtesseract_collision_bullet_factories-*.so"))
    return PLUGINS.format(folder=LIBRARIES, library=library.stem.removeprefix("lib"), manager=MANAGER)


def triangles(file: Path, kind: type = geometry.Mesh) -> geometry.Geometry:
    vertices, corners = read_mesh(file)
    points = common.VectorVector3d()
    for vertex in vertices:
        points.append(vertex)
    faces = np.insert(corners, 0, 3, axis=1)  # each face begins with its number of vertices
    return kind(points, faces.astype(np.int32).reshape(-1, 1))


class Arm:
    def __init__(self, robot: Robot, cell: Cell) -> None:
        self.model = pinocchio.buildModelFromUrdf(str(robot.urdf))
        self.data = self.model.createData()
        self.links = [(link, self.model.getFrameId(link)) for link in robot.meshes if link != robot.base]
        self.factory = collision.ContactManagersPluginFactory(plugins(), common.GeneralResourceLocator())
        self.manager = self.factory.createContinuousContactManager(MANAGER)
        for link, file in robot.meshes.items():
            self.add(link, triangles(file, geometry.ConvexMesh), np.eye(4))
        for k, obstacle in enumerate(cell.obstacles):
            self.add(f"obstacle {k}", obstacle.shape(geometry, triangles), obstacle.transform)
        self.manager.setActiveCollisionObjects([link for link, _ in self.links])
        config = collision.ContactManagerConfig(0.0)
        config.acm = common.AllowedCollisionMatrix()
        for first, second in robot.ignored:
            config.acm.addAllowedCollision(first, second, "SRDF")
        config.acm_override_type = collision.ACMOverrideType_ASSIGN
        self.manager.applyContactManagerConfig(config)
        self.request = collision.ContactRequest(collision.ContactTestType_FIRST)
        self.request.calculate_penetration = self.request.calculate_distance = True

    def add(self, name: str, body: geometry.Geometry, pose: Floats) -> None:
        bodies, poses = geometry.GeometriesConst(), common.VectorIsometry3d()
        bodies.append(body)
        poses.append(common.Isometry3d(np.eye(4)))
        assert self.manager.addCollisionObject(name, 0, bodies, poses)
        self.manager.setCollisionObjectsTransform(name, common.Isometry3d(pose))

    def poses(self, at: Configuration) -> list[common.Isometry3d]:
        pinocchio.framesForwardKinematics(self.model, self.data, at)
        return [common.Isometry3d(self.data.oMf[frame].homogeneous) for _, frame in self.links]

    def edge_is_free(self, start: Configuration, end: Configuration) -> bool:
        stretches = max(1, int(np.ceil(np.linalg.norm(end - start) / STRETCH)))
        before = self.poses(start)
        for fraction in np.arange(1, stretches + 1) / stretches:
            after = self.poses(start + fraction * (end - start))
            for (link, _), low, high in zip(self.links, before, after, strict=True):
                self.manager.setCollisionObjectsTransform(link, low, high)
            found = collision.ContactResultMap()
            self.manager.contactTest(found, self.request)
            if found.size() > 0:
                return False
            before = after
        return True


def checks(robot: Robot, cell: Cell, steps: list[int]) -> Iterator[tuple[str, Measure]]:
    yield f"cast {STRETCH} rad", one_by_one(Arm(robot, cell).edge_is_free)
