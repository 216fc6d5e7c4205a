"""Valid and invalid inputs from four threads at once give exceptions of the right type, and leak no memory.

CCD_TEST_CASES=50 multiplies the number of calls: a million.
"""

import gc
import math
import os
import random
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigid_ccd import (
    Body,
    InputError,
    Joint,
    Motion,
    Robot,
    Table,
    UnresolvedError,
    closest_approach,
    distance,
    first_contact,
    first_contacts,
    is_free,
)

CALLS = int(20_000 * float(os.environ.get("CCD_TEST_CASES", "1")))
BALL, WALL = Body.sphere(0.5), Body.box(0.1, 5, 5)
RODS = Body.capsule(0.01, 2)
SPINS = Motion([-3, 0, 0], velocity=[4, 0, 0], angular_velocity=[300, 200, 100])
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]])
ORIGIN: Any = ([0, 0, 0], [0, 0, 0, 1])
WIDE = np.zeros((4, 8))
ODD = np.frombuffer(bytearray(1 + 8 * 6), dtype=np.uint8)[1:].view(np.float64)
ODD[:] = 1
any_call: Callable[..., Any] = first_contact
any_body: Callable[..., Any] = Body
any_motion: Callable[..., Any] = Motion
any_table: Callable[..., Any] = first_contacts


def closed_reader() -> Any:
    """A stream of Arrow batches that was read to its end."""
    reader = pytest.importorskip("pyarrow").table({"a_px": [1.0]}).to_reader()
    first_contacts(BALL, WALL, reader)
    return reader


GOOD: list[Callable[[], Any]] = [
    lambda: any_call(BALL, WALL, Motion([-3, 0, 0], velocity=[4, 0, 0])),
    lambda: is_free(BALL, WALL, Motion.still(ORIGIN)),
    lambda: closest_approach(BALL, WALL, Motion([-3, 0, 0], angular_velocity=[0, 1, 0])),
    lambda: distance(BALL, WALL, np.eye(4)),
    lambda: any_body(CORNERS[:, ::-1], FACES),
    lambda: any_body(CORNERS.astype(np.float32), FACES.astype(np.uint8).tolist()),
    lambda: any_table(BALL, WALL, {"a_px": WIDE[:, ::-2][:, 0], "a_vx": np.arange(4, dtype=np.float32)}),
    lambda: any_table(BALL, WALL, {"a_px": ODD, "id": ["x"] * 6})["id"],
    lambda: any_table(BALL, WALL, {"a_px": [math.nan, math.inf, -3]}, threads=2).take([2, 0])["reason"],
    lambda: Table(Table({"a_px": np.arange(9.0)})).keys(),
    lambda: Robot([Joint.revolute("hinge", "base", "lid")]).link_trajectory("lid", [0], [1]).pose(0.5),
]

BAD: list[tuple[type[BaseException], Callable[[], Any]]] = [
    (TypeError, lambda: any_call(BALL, None)),
    (TypeError, lambda: any_call(BALL, WALL, [1, 2, 3])),
    (TypeError, lambda: any_call(BALL, WALL, speed=3)),
    (TypeError, lambda: any_call(BALL, WALL, tolerance="small")),
    (InputError, lambda: any_call(BALL, WALL, tolerance=-1)),
    (InputError, lambda: any_call(BALL, WALL, duration=math.nan)),
    (InputError, lambda: any_motion([1, 2])),
    (InputError, lambda: any_motion([1, 2, math.nan])),
    (InputError, lambda: any_motion([1e300, 0, 0], velocity=[math.inf] * 3)),
    (InputError, lambda: any_motion("here")),
    (InputError, lambda: any_motion(rotation=np.zeros((3, 3)))),
    (InputError, lambda: any_body(CORNERS * np.nan, FACES)),
    (InputError, lambda: any_body(CORNERS, FACES + 5)),
    (InputError, lambda: any_body(CORNERS, FACES - 9)),
    (InputError, lambda: any_body(CORNERS, FACES.astype(float))),
    (InputError, lambda: any_body(CORNERS * 1e200, FACES)),
    (InputError, lambda: any_body([], [])),
    (InputError, lambda: any_body([[object()] * 3], FACES)),
    (TypeError, lambda: Body.from_trimesh(3)),  # type: ignore[arg-type]
    (OSError, lambda: Body.from_file("nowhere.obj")),
    (InputError, lambda: Body.sphere(math.inf)),
    (TypeError, lambda: any_table(BALL, WALL, 3)),
    (InputError, lambda: any_table(BALL, WALL, {})),
    (InputError, lambda: any_table(BALL, WALL, {"a_x": [1.0]})),
    (InputError, lambda: any_table(BALL, WALL, {"a_px": ["x"]})),
    (InputError, lambda: any_table(BALL, WALL, {"a_px": np.zeros((2, 2))})),
    (InputError, lambda: any_table(BALL, WALL, {"a_px": np.zeros(2), "a_py": np.zeros(3)})),
    (InputError, lambda: any_table(BALL, WALL, {"a_px": np.zeros(2, complex)})),
    (KeyError, lambda: any_table(BALL, WALL, {"a_px": [1.0]})["times"]),
    (ZeroDivisionError, lambda: any_table(BALL, WALL, {"a_px": [1.0]}, progress=lambda *_: 1 / 0)),
    (UnresolvedError, lambda: any_call(RODS, RODS, SPINS, tolerance=1e-9, budget=1)),
]


def call(number: int) -> None:
    """Makes one of the calls, and checks its result."""
    draw = random.Random(number)
    if draw.random() < 0.3:
        draw.choice(GOOD)()
        return
    expected, bad = draw.choice(BAD)
    try:
        bad()
    except expected:
        return
    raise AssertionError(f"call {number} was accepted")


def resident() -> int:
    """Returns the memory of this process, in bytes."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def from_four_threads(first: int, count: int) -> None:
    faults: list[BaseException] = []

    def some(thread: int) -> None:
        try:
            for number in range(first + thread, first + count, 4):
                call(number)
        except BaseException as fault:  # noqa: BLE001
            faults.append(fault)

    threads = [threading.Thread(target=some, args=(thread,)) for thread in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if faults:
        raise faults[0]


@pytest.mark.skipif(sys.platform != "linux", reason="reads the process's memory from /proc")
def test_nothing_crashes_and_no_memory_is_kept() -> None:
    # The first rounds warm up the allocators.
    from_four_threads(0, min(CALLS, 20_000))
    gc.collect()
    before = resident()
    references = [sys.getrefcount(thing) for thing in (BALL, WALL, CORNERS, FACES, ODD)]
    from_four_threads(1_000_000, CALLS)
    gc.collect()
    after = resident()
    assert [sys.getrefcount(thing) for thing in (BALL, WALL, CORNERS, FACES, ODD)] == references
    # A million calls show a leak of ten bytes for each call. With few calls it would be lost in the allocator's noise.
    grown = after - before
    print(f"{CALLS} calls: {before / 1e6:.1f} MB before, {grown / 1e6:+.1f} MB after")
    assert grown < 8e6, f"{grown} bytes more after {CALLS} calls"


def test_a_stream_that_was_read_has_no_rows() -> None:
    try:
        found = first_contacts(BALL, WALL, closed_reader())
    except (InputError, ValueError):
        return
    assert len(found) == 0
