"""Drake's SceneGraphCollisionChecker, which tests configurations at steps of 0.05 rad.

It takes meshes as their hulls.
"""

from collections.abc import Iterator
from importlib.metadata import version

import numpy as np
from pydrake import geometry
from pydrake.math import RigidTransform
from pydrake.multibody.plant import CoulombFriction
from pydrake.planning import CollisionCheckerParams, RobotDiagramBuilder, SceneGraphCollisionChecker

from data import Cell, Robot
from measure import Measure, one_by_one

TITLE, VERSION = "Drake", version("drake")
STEP = 0.05  # radians


def checks(robot: Robot, cell: Cell, steps: list[int]) -> Iterator[tuple[str, Measure]]:
    builder = RobotDiagramBuilder(0.0)
    plant = builder.plant()
    (arm,) = builder.parser().AddModels(str(robot.urdf))
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName(robot.base))
    for k, obstacle in enumerate(cell.obstacles):
        shape = obstacle.shape(geometry, lambda file: geometry.Mesh(str(file)))
        pose, friction = RigidTransform(obstacle.transform), CoulombFriction(1.0, 1.0)
        plant.RegisterCollisionGeometry(plant.world_body(), pose, shape, f"obstacle {k}", friction)
    plant.Finalize()
    checker = SceneGraphCollisionChecker(
        CollisionCheckerParams(
            model=builder.Build(),
            robot_model_instances=[arm],
            edge_step_size=STEP,
            env_collision_padding=0.0,
            self_collision_padding=0.0,
            configuration_distance_function=lambda start, end: float(np.linalg.norm(end - start)),
        )
    )
    bodies = {link: checker.plant().GetBodyByName(link) for link in robot.meshes}
    for pairs, filtered in ((robot.ignored, True), (robot.checked, False)):
        for first, second in pairs:
            checker.SetCollisionFilteredBetween(bodies[first], bodies[second], filtered)
    yield f"{STEP} rad", one_by_one(checker.CheckEdgeCollisionFree)
