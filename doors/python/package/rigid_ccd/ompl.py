"""Certified motions for planners of OMPL 2 (``pip install ompl``).

>>> from ompl import base, geometric
>>> from rigid_ccd.ompl import MotionValidator, StateValidityChecker, space_of
>>> space = space_of(cell)                                        # doctest: +SKIP
>>> setup = geometric.SimpleSetup(space)                          # doctest: +SKIP
>>> information = setup.getSpaceInformation()                     # doctest: +SKIP
>>> setup.setStateValidityChecker(StateValidityChecker(information, cell))  # doctest: +SKIP
>>> information.setMotionValidator(MotionValidator(information, cell))      # doctest: +SKIP

Each edge of a path that the planner returns is then proven free along its whole length.
"""

from collections.abc import Mapping
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray
from ompl import base

from ._answers import PathContact
from ._rigid_ccd import Cell
from ._settings import OfContacts


class _States:
    """Converts states of a real vector space to configurations of a robot, and answers questions about them."""

    def __init__(self, cell: Cell, fixed: Mapping[str, float] | None, settings: OfContacts) -> None:
        fixed = fixed or {}
        names = cell.robot.joint_names
        if unknown := set(fixed) - set(names):
            raise ValueError(f"fixed: the robot has no joint {', '.join(sorted(unknown))}")
        self.planned = [k for k, name in enumerate(names) if name not in fixed]
        self._configuration = np.array([fixed.get(name, 0.0) for name in names])
        self._cell, self._settings = cell, settings

    def is_free(self, *states: Any) -> bool:
        return self._cell.is_free(self._path(states), **self._settings)

    def first_contact(self, *states: Any) -> PathContact | None:
        return self._cell.first_contact(self._path(states), **self._settings)

    def _path(self, states: tuple[Any, ...]) -> NDArray[np.float64]:
        path = np.tile(self._configuration, (len(states), 1))
        for configuration, state in zip(path, states, strict=True):
            for k, joint in enumerate(self.planned):
                configuration[joint] = state[k]
        return path


def space_of(cell: Cell, fixed: Mapping[str, float] | None = None) -> Any:
    """Returns the real vector space of a robot's independent joints, bounded by their limits.

    Args:
        cell: the cell with the robot.
        fixed: the positions of joints that do not move, by their names.
    """
    planned = _States(cell, fixed, {}).planned
    limits = cell.robot.limits[planned]
    if not np.isfinite(limits).all():
        raise ValueError("a joint has no limits: make the space yourself, with bounds for it")
    space, bounds = base.RealVectorStateSpace(len(planned)), base.RealVectorBounds(len(planned))
    for k, (low, high) in enumerate(limits):
        bounds.setLow(k, float(low))
        bounds.setHigh(k, float(high))
    space.setBounds(bounds)
    return space


class StateValidityChecker(base.StateValidityChecker):  # type: ignore[misc, unused-ignore]
    """Accepts a state if the robot touches nothing.

    Args:
        information: the information of a real vector space that has a dimension for each joint not in `fixed`.
        cell: the cell, which may change between calls.
        fixed: the positions of joints that do not move, by their names.
        settings: the same as for `Cell.is_free`.
    """

    def __init__(
        self,
        information: Any,
        cell: Cell,
        fixed: Mapping[str, float] | None = None,
        **settings: Unpack[OfContacts],
    ) -> None:
        super().__init__(information)
        self._states = _States(cell, fixed, settings)

    def isValid(self, state: Any) -> bool:  # noqa: N802
        return self._states.is_free(state)


class MotionValidator(base.MotionValidator):  # type: ignore[misc, unused-ignore]
    """Accepts a motion between two states if it is proven that the robot touches nothing on it.

    The arguments are those of `StateValidityChecker`.
    """

    def __init__(
        self,
        information: Any,
        cell: Cell,
        fixed: Mapping[str, float] | None = None,
        **settings: Unpack[OfContacts],
    ) -> None:
        super().__init__(information)
        self._states = _States(cell, fixed, settings)

    def checkMotion(self, start: Any, end: Any) -> bool:  # noqa: N802
        return self._states.is_free(start, end)

    def last_valid(self, start: Any, end: Any) -> float:
        """Returns the fraction of the motion that is free, from its start; 1 if all of it is free.

        It replaces the third argument of `checkMotion` in C++, which OMPL's interface to Python does not have.
        """
        contact = self._states.first_contact(start, end)
        return 1.0 if contact is None else contact.fraction
