"""Coal with Pinocchio's kinematics: its broad phase, and its tests of configurations at equal steps."""

from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

import coal
import pinocchio

from data import Cell, Obstacle, Robot, read_mesh
from measure import Configuration, Measure, at_steps

TITLE, VERSION = "Coal and Pinocchio", f"{version('coal')} {version('pin')}"


def hull(file: Path) -> Any:
    points = coal.StdVec_Vec3s()
    points.extend(read_mesh(file)[0])
    return coal.Convex.convexHull(points, True, "Qt")


def triangles(file: Path) -> Any:
    vertices, faces = read_mesh(file)
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(faces), len(vertices))
    mesh.addVertices(vertices)
    mesh.addTriangles(faces)
    mesh.endModel()
    return mesh


def shape(obstacle: Obstacle) -> Any:
    return obstacle.shape(coal, triangles)


def placement(obstacle: Obstacle) -> pinocchio.SE3:
    return pinocchio.SE3(obstacle.transform)


class Arm:
    def __init__(self, robot: Robot, cell: Cell) -> None:
        self.model = pinocchio.buildModelFromUrdf(str(robot.urdf))
        self.data = self.model.createData()
        bodies = pinocchio.GeometryModel()
        links = {}
        for link, file in robot.meshes.items():
            frame = self.model.frames[self.model.getFrameId(link)]
            body = pinocchio.GeometryObject(link, frame.parentJoint, frame.placement, hull(file))
            links[link] = bodies.addGeometryObject(body)
        for k, obstacle in enumerate(cell.obstacles):
            body = pinocchio.GeometryObject(f"obstacle {k}", 0, placement(obstacle), shape(obstacle))
            other = bodies.addGeometryObject(body)
            for link in links:
                if link != robot.base:
                    bodies.addCollisionPair(pinocchio.CollisionPair(links[link], other))
        for first, second in robot.checked:
            bodies.addCollisionPair(pinocchio.CollisionPair(links[first], links[second]))
        self.bodies, self.bodies_data = bodies, pinocchio.GeometryData(bodies)
        broad_phase = pinocchio.BroadPhaseManager_DynamicAABBTreeCollisionManager
        self.broad_phase = broad_phase(self.model, self.bodies, self.bodies_data)

    def is_free(self, at: Configuration) -> bool:
        return not pinocchio.computeCollisions(self.model, self.data, self.broad_phase, at, True)


def checks(robot: Robot, cell: Cell, steps: list[int]) -> Iterator[tuple[str, Measure]]:
    arm = Arm(robot, cell)
    for count in steps:
        yield f"{count} steps", at_steps(arm.is_free, count)
