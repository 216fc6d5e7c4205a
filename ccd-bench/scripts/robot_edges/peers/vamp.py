"""VAMP's vectorised tests of configurations, in f32, over spheres of its own for the Panda: vamp.cpp, compiled.

Its Python package tests one configuration a radian, where its planners test 32. It does not read meshes as triangles.
"""

import ctypes
import os
from collections.abc import Iterator

import numpy as np

from data import Bools, Cell, Floats, Robot
from measure import Measure, together

if "VAMP_EDGES" not in os.environ:
    raise ImportError("VAMP_EDGES does not name the compiled vamp.cpp")
TITLE, VERSION = "VAMP", os.environ.get("VAMP_VERSION", "")
LIBRARY = ctypes.CDLL(os.environ["VAMP_EDGES"])


def pointer(array: np.ndarray) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


def check(edges: Floats) -> Bools:
    numbers, free = np.ascontiguousarray(edges, np.float32), np.zeros(len(edges), np.bool_)
    LIBRARY.check(pointer(numbers), ctypes.c_size_t(len(edges)), pointer(free))
    return free


def checks(robot: Robot, cell: Cell, steps: list[int]) -> Iterator[tuple[str, Measure]]:
    if robot.urdf.stem != "panda" or any(obstacle.mesh for obstacle in cell.obstacles):
        return
    LIBRARY.clear()
    for obstacle in cell.obstacles:
        sizes, pose = np.array(obstacle.sizes, np.float32), np.asfortranarray(obstacle.transform, np.float32)
        LIBRARY.add_shape(ctypes.c_char(obstacle.kind[0].encode()), pointer(sizes), pointer(pose))
    yield f"{LIBRARY.resolution()} a radian", together(check)
