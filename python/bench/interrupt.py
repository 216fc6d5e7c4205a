"""Measures how soon Ctrl-C ends a table whose rows take minutes.

    python bench/interrupt.py [REPEAT]
"""

import os
import signal
import statistics
import sys
import threading
import time
from pathlib import Path

import numpy as np

from rigid_ccd import Interrupted, first_contacts

sys.path.append(str(Path(__file__).parents[1] / "tests"))
from test_tables import knot  # noqa: E402


def main() -> None:
    # A background job of a shell ignores Ctrl-C by default.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    body = knot(600)
    # The knot makes a hundred thousand turns past another one.
    rows = np.linspace(3.2, 3.4, 1000)
    motions = {"a_px": rows, "a_wx": np.full(1000, 6e5), "a_wy": np.full(1000, 6e5)}
    taken = []
    for _ in range(int(sys.argv[1]) if len(sys.argv) > 1 else 10):
        sent = []

        def send() -> None:
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Timer(1, send).start()
        try:
            first_contacts(body, body, motions, tolerance=1e-9, budget=2**60)
        except Interrupted as interrupted:
            taken.append(time.perf_counter() - sent[0])
            print(f"{1e3 * taken[-1]:7.1f} ms after Ctrl-C, {interrupted.results}")
    print(f"median {1e3 * statistics.median(taken):.1f} ms, longest {1e3 * max(taken):.1f} ms")


if __name__ == "__main__":
    main()
