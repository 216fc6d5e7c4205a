"""HPP's continuous validations of paths, over convex links."""

from collections.abc import Iterator
from importlib.metadata import version
from typing import Any

import pinocchio
from pyhpp.core import Dichotomy, Problem, Progressive, Straight
from pyhpp.pinocchio import Device
from pyhpp.pinocchio.urdf import loadModelFromString

from data import Cell, Robot
from measure import Configuration, Measure, one_by_one
from peers.coal import hull, placement, shape

TITLE, VERSION = "HPP", version("hpp-core")
PLACEHOLDER = '<sphere radius="0.01"/>'


def with_placeholders(robot: Robot, cell: Cell) -> str:
    """Returns the URDF with absolute paths, and with a fixed link for each obstacle, which has a small sphere.

    HPP's bounds of velocities are of the meshes that it loads: they have to be those of the links.
    """
    text = robot.urdf.read_text().replace('mesh filename="', f'mesh filename="{robot.urdf.parent.absolute()}/')
    for k in range(len(cell.obstacles)):
        link = f'<link name="obstacle{k}"><collision><geometry>{PLACEHOLDER}</geometry></collision></link>'
        joint = f'<parent link="{robot.base}"/><child link="obstacle{k}"/>'
        text = text.replace("</robot>", f'{link}<joint name="fix{k}" type="fixed">{joint}</joint></robot>')
    return text


def load(robot: Robot, cell: Cell) -> Device:
    """Loads the robot, and replaces meshes by their hulls, and the spheres by the obstacles."""
    device = Device(robot.urdf.stem)
    urdf, srdf = with_placeholders(robot, cell), robot.srdf.read_text()
    loadModelFromString(device, 0, "", "anchor", urdf, srdf, pinocchio.SE3.Identity())
    bodies = device.geomModel()
    for body in bodies.geometryObjects:
        link = body.name.rsplit("_", 1)[0]
        if link in robot.meshes:
            body.geometry = hull(robot.meshes[link])
        else:
            obstacle = cell.obstacles[int(link.removeprefix("obstacle"))]
            body.geometry, body.placement = shape(obstacle), placement(obstacle)
        body.geometry.computeLocalAABB()
    moving = len(robot.meshes) - 1
    assert len(bodies.collisionPairs) == len(robot.checked) + moving * len(cell.obstacles)
    return device


def checks(robot: Robot, cell: Cell, steps: list[int]) -> Iterator[tuple[str, Measure]]:
    device = load(robot, cell)
    problem = Problem(device)
    straight = Straight(problem)
    ways = {"Dichotomy": Dichotomy(device, 0.0), "Progressive 1e-3": Progressive(device, 1e-3)}
    for name, validation in ways.items():

        def is_free(start: Configuration, end: Configuration, validation: Any = validation) -> bool:
            return bool(validation.validate(straight(start, end), False)[0])

        yield f"{name} convex links", one_by_one(is_free)
