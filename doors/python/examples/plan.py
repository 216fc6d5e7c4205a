"""Plans a path of a Franka Panda with OMPL, proves it, and times it along a smooth curve.

    pip install example-robot-data ompl scipy
    python plan.py

Each motion that the planner tries is proven free along its whole length. The path is then smoothed to a curve for the
controller. The curve is certified too, because it differs from the straight lines of the planner.
"""

from importlib.metadata import files

import numpy as np
from ompl import geometric, util
from scipy.interpolate import CubicSpline

from rigid_ccd import Body, Cell, Robot
from rigid_ccd.ompl import MotionValidator, StateValidityChecker, space_of

# %% The robot, and a cell with a shelf of thin boards
package = {path.name: path.locate() for path in files("example-robot-data") or []}
cell = Cell(Robot.from_urdf(package["panda.urdf"], package["panda.srdf"], meshes="hull"))
UPRIGHT = [0, 0, 0, 1]
for k, height in enumerate([0.2, 0.5, 0.8]):
    cell.add_obstacle(f"board {k}", Body.box(size=(0.4, 0.8, 0.004)), ([0.6, 0, height], UPRIGHT))
FINGERS = {"panda_finger_joint1": 0.02}
start = np.array([-1.2, -0.6, 0.0, -2.3, 0.0, 1.8, 0.8])
goal = np.array([1.2, -0.2, 0.0, -2.0, 0.0, 1.9, 0.8])

# %% The plan
util.setLogLevel(util.LOG_WARN)
setup = geometric.SimpleSetup(space_of(cell, FINGERS))
information = setup.getSpaceInformation()
setup.setStateValidityChecker(StateValidityChecker(information, cell, FINGERS))
information.setMotionValidator(MotionValidator(information, cell, FINGERS))
states = [information.allocState(), information.allocState()]
for state, configuration in zip(states, (start, goal), strict=True):
    for k, position in enumerate(configuration):
        state[k] = float(position)
setup.setStartAndGoalStates(*states)
setup.setPlanner(geometric.RRTConnect(information))
assert setup.solve(5.0), "no path was found"
setup.simplifySolution()
found = setup.getSolutionPath().getStates()
path = np.array([[*(state[k] for k in range(7)), *FINGERS.values()] for state in found])
assert cell.is_free(path)
nearest = cell.closest_approach(path)
print(f"a path of {len(path)} configurations is free; it comes within {1000 * nearest.upper:.1f} mm of a contact")

# %% The curve
# Adds points on the straight lines until the spline is near enough to them to be proven free.
for count in 2 ** np.arange(0, 7):
    fractions = np.linspace(0, len(path) - 1, count * (len(path) - 1) + 1)
    points = np.stack([np.interp(fractions, np.arange(len(path)), joint) for joint in path.T], axis=1)
    seconds = 2 * fractions
    curve = CubicSpline(seconds, points, bc_type="clamped")
    contact = cell.first_contact(curve)
    if contact is None:
        print(f"a spline through {len(points)} points is free for all of its {seconds[-1]:.0f} s")
        break
    print(f"a spline through {len(points)} points: {contact.a} touches {contact.b} after {contact.time:.2f} s")
