"""Planners of OMPL on a cell: no path that they return touches anything."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_cells import URDF

from rigid_ccd import Body, Cell, Robot

base = pytest.importorskip("ompl.base")
geometric = pytest.importorskip("ompl.geometric")


@pytest.fixture
def cell(tmp_path: Path) -> Cell:
    file = tmp_path / "arm.urdf"
    file.write_text(URDF)
    cell = Cell(Robot.from_urdf(file))
    # A sheet of 1 mm. Sampling at steps of a hundredth of the space misses it.
    sheet: Any = ([0, 1.5, 0], [0, 0, 0, 1])
    cell.add_obstacle("sheet", Body.box(0.0005, 0.3, 0.3), sheet)
    return cell


def plan(cell: Cell, certified: bool, held: dict[str, float] | None = None) -> list[Any]:
    from rigid_ccd.ompl import MotionValidator, StateValidityChecker, space_of

    setup = geometric.SimpleSetup(space_of(cell, held))
    information = setup.getSpaceInformation()
    setup.setStateValidityChecker(StateValidityChecker(information, cell, held))
    if certified:
        information.setMotionValidator(MotionValidator(information, cell, held))
    start, goal = information.allocState(), information.allocState()
    for state, angle in ((start, 0.5), (goal, 2.6)):
        state[0] = angle
        if held is None:
            state[1] = 0.0
    setup.setStartAndGoalStates(start, goal)
    setup.setPlanner(geometric.RRTConnect(information))
    if not setup.solve(2.0):
        return []
    count = 1 if held else 2
    return [[state[k] for k in range(count)] for state in setup.getSolutionPath().getStates()]


def test_a_certified_path_touches_nothing(cell: Cell) -> None:
    path = plan(cell, certified=True)
    assert len(path) > 1
    assert all(cell.is_free([a, b]) for a, b in zip(path, path[1:], strict=False))
    # The straight motion touches the sheet.
    assert not cell.is_free([[0.5, 0], [2.6, 0]])


def test_the_last_free_share_is_that_of_the_first_contact(cell: Cell) -> None:
    from rigid_ccd.ompl import MotionValidator, space_of

    space = space_of(cell)
    validator = MotionValidator(base.SpaceInformation(space), cell, tolerance=1e-6)
    a, b, near = space.allocState(), space.allocState(), space.allocState()
    a[0], a[1], b[0], b[1], near[0], near[1] = 0.5, 0.0, 2.6, 0.0, 0.6, 0.0
    contact = cell.first_contact([[0.5, 0], [2.6, 0]], tolerance=1e-6)
    assert contact is not None and validator.last_valid(a, b) == contact.fraction
    assert not validator.checkMotion(a, b)
    assert validator.checkMotion(a, near) and validator.last_valid(a, near) == 1


def test_held_joints_keep_their_position(cell: Cell) -> None:
    # With the elbow bent the ball is too short to meet the sheet.
    path = plan(cell, certified=True, held={"elbow": 2.9})
    assert [np.shape(state) for state in path] == [(1,)] * len(path) and len(path) > 1
    # With the elbow straight no path leads past the sheet.
    assert plan(cell, certified=True, held={"elbow": 0.0}) == [] or not cell.is_free([[0.5, 0], [2.6, 0]])
    with pytest.raises(ValueError, match="no joint wrist"):
        plan(cell, certified=True, held={"wrist": 0.0})
