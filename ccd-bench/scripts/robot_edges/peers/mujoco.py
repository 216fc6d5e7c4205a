"""MuJoCo: contacts at equal steps, and its flag `speculative`. It takes meshes as their hulls."""

from collections.abc import Iterator
from importlib.metadata import version

import mujoco

from data import Cell, Robot
from measure import Configuration, Measure, at_steps, halving_order, one_by_one

TITLE, VERSION = "MuJoCo", version("mujoco")
STRETCHES = 5
SPECULATIVE = int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)


def read_model(robot: Robot, cell: Cell) -> mujoco.MjModel:
    """Adds a body of all obstacles to the robot."""
    spec = mujoco.MjSpec.from_file(str(robot.urdf))
    spec.strippath, spec.compiler.fusestatic = False, False
    obstacles = spec.worldbody.add_body(name="obstacles")
    for obstacle in cell.obstacles:
        geom = obstacles.add_geom(type=getattr(mujoco.mjtGeom, f"mjGEOM_{obstacle.kind.upper()}"))
        geom.pos, geom.quat = obstacle.position, obstacle.quaternion
        geom.size = [*obstacle.sizes, 0, 0, 0][:3]
        if obstacle.mesh:
            mesh = spec.add_mesh(name=obstacle.mesh.stem, file=str(obstacle.mesh.absolute()))
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
            geom.meshname = mesh.name
    for first, second in robot.ignored:
        spec.add_exclude(bodyname1=first, bodyname2=second)
    model = spec.compile()
    assert model.nq == robot.joints
    model.opt.timestep = 1.0
    return model


class Arm:
    def __init__(self, robot: Robot, cell: Cell) -> None:
        self.model = read_model(robot, cell)
        self.data = mujoco.MjData(self.model)

    def is_free(self, at: Configuration) -> bool:
        self.data.qpos[:] = at
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_collision(self.model, self.data)
        return bool(self.data.ncon == 0)

    def is_free_onwards(self, at: Configuration, way: Configuration) -> bool:
        """Looks for contacts of the step that begins here, in which the joints turn by `way`."""
        self.data.qpos[:] = at
        self.data.qvel[:] = way
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_comVel(self.model, self.data)
        mujoco.mj_collision(self.model, self.data)
        return bool(self.data.ncon == 0)

    def edge_is_free(self, start: Configuration, end: Configuration) -> bool:
        """Tests the end, then stretches of the edge as steps of time with the flag `speculative`."""
        self.model.opt.enableflags &= ~SPECULATIVE
        if not self.is_free(end):
            return False
        self.model.opt.enableflags |= SPECULATIVE
        way = (end - start) / STRETCHES
        free = all(self.is_free_onwards(start + (k - 1) * way, way) for k in halving_order(STRETCHES))
        self.model.opt.enableflags &= ~SPECULATIVE
        return free


def checks(robot: Robot, cell: Cell, steps: list[int]) -> Iterator[tuple[str, Measure]]:
    arm = Arm(robot, cell)
    for count in steps:
        yield f"{count} steps", at_steps(arm.is_free, count)
    yield f"speculative {STRETCHES} stretches", one_by_one(arm.edge_is_free)
