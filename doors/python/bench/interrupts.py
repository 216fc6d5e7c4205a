"""Prints the time from Ctrl-C to the end of a call, for each call that may take long."""

import os
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from test_interrupts import CELL, ENDS, HARD, KNOT, LONG, MISSES, STARTS, knot

from rigid_ccd import Body, Robot, TableQuery, closest_approach, first_contact, first_contacts, is_free, prove


def latency(call: Callable[[], Any]) -> float:
    """Interrupts a call after half a second, and returns the seconds until it has ended."""
    sent: list[float] = []

    def send() -> None:
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.5, send)
    timer.start()
    try:
        call()
    except KeyboardInterrupt:
        return time.perf_counter() - sent[0]
    timer.cancel()
    return float("nan")


def main() -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)
    vertices, faces = knot(60_000)
    rows = 100_000
    table = {"id": np.arange(rows), "a_px": np.full(rows, 3.3), "a_wx": np.full(rows, 6e5), "a_wy": np.full(rows, 6e5)}
    path = np.linspace(0, 0.1, 500_000)[:, None]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "knot.obj"
        lines = [*(f"v {x} {y} {z}" for x, y, z in vertices), *(f"f {a} {b} {c}" for a, b, c in faces + 1)]
        file.write_text("\n".join(lines))
        geometry = f'<collision><geometry><mesh filename="{file}"/></geometry></collision>'
        urdf = f'<robot name="r"><link name="a">{geometry}{9 * geometry}</link></robot>'
        calls: dict[str, Callable[[], Any]] = {
            "first_contact": lambda: first_contact(KNOT, KNOT, MISSES, **HARD),
            "is_free": lambda: is_free(KNOT, KNOT, MISSES, **HARD),
            "closest_approach": lambda: closest_approach(KNOT, KNOT, MISSES, **HARD),
            "prove": lambda: prove(KNOT, KNOT, MISSES, **HARD),
            "first_contacts": lambda: first_contacts(KNOT, KNOT, table, **HARD),
            "TableQuery": lambda: TableQuery(KNOT, KNOT, **HARD)(table),
            "Cell.is_free": lambda: CELL.is_free(LONG, **HARD),
            "Cell.first_contact": lambda: CELL.first_contact(LONG, **HARD),
            "Cell.closest_approach": lambda: CELL.closest_approach(LONG, **HARD),
            "Cell.clearance_ranges": lambda: CELL.clearance_ranges(LONG, resolution=1e-9, **HARD),
            "Cell.answer_edges": lambda: CELL.answer_edges(STARTS, ENDS, "first-contact", **HARD),
            "Cell.answer_paths": lambda: CELL.answer_paths(np.stack([STARTS, ENDS], 1), "closest-approach", **HARD),
            "Cell.prove": lambda: CELL.prove(path),
            "Body": lambda: Body(vertices, faces, pieces="patches"),
            "Body.from_file": lambda: Body.from_file(file, pieces="patches"),
            "Robot.from_urdf_text": lambda: Robot.from_urdf_text(urdf),
        }
        print("| call | seconds after Ctrl-C |\n|---|---|")
        for name, call in calls.items():
            print(f"| `{name}` | {latency(call):.3f} |")


if __name__ == "__main__":
    main()
