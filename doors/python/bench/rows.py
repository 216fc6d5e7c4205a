"""Compares the cost of a table in Python with that of the command `ccd`, in one run.

    python bench/rows.py A.obj B.obj motions.csv --ccd target/release/ccd

The rows are repeated until there are --rows. Both alternate --repeat times, each time in a process of its own, because
the location of bodies in memory changes the speed by 1 to 2 %. Seconds are medians. Ratios are medians of the ratios of
neighbouring runs, which depend least on the changing speed of the machine. The times of contact must have the same
bits.
"""

import argparse
import csv
import statistics
import subprocess
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np

import rigid_ccd


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a")
    parser.add_argument("b")
    parser.add_argument("motions")
    parser.add_argument("--ccd", required=True, help="the command")
    parser.add_argument("--rows", type=int, default=100_000)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    given = parser.parse_args()

    with open(given.motions, newline="") as file:
        header, *lines = csv.reader(file)
    lines = [lines[k % len(lines)] for k in range(given.rows)]
    columns = {
        name: np.array([line[k] for line in lines]).astype("str" if name == "id" else "float64")
        for k, name in enumerate(header)
    }
    alone = ProcessPoolExecutor(1, get_context("spawn"), max_tasks_per_child=1)
    with tempfile.TemporaryDirectory() as folder, alone:
        motions, results = (Path(folder) / name for name in ("motions.csv", "results.csv"))
        with open(motions, "w", newline="") as file:
            csv.writer(file).writerows([header, *lines])
        print(f"{given.rows} rows\nthreads   python s  command s  python/command")
        for threads in given.threads:
            taken: dict[str, list[float]] = {"python": [], "command": []}
            for _ in range(given.repeat):
                seconds, bits, status = alone.submit(answer, given.a, given.b, columns, threads).result()
                taken["python"].append(seconds)

                bodies = ["--a", given.a, "--b", given.b, "--motions", motions, "--out", results]
                begin = time.perf_counter()
                subprocess.run([*map(str, [given.ccd, "query", *bodies, "--threads", threads, "-q"])], check=True)
                taken["command"].append(time.perf_counter() - begin)
                with open(results, newline="") as file:
                    told = np.array([float(row["time"]) for row in csv.DictReader(file)])
                assert np.array_equal(bits, told.view(np.uint64)), "other bits than the command's"
            medians = "  ".join(f"{statistics.median(seconds):9.3f}" for seconds in taken.values())
            ratio = statistics.median(ours / theirs for ours, theirs in zip(*taken.values(), strict=True))
            print(f"{threads:7}  {medians}  {ratio:14.3f}")
        counts = dict(zip(*np.unique(status, return_counts=True), strict=True))
        print(f"equal bits; {', '.join(f'{count} {status}' for status, count in counts.items())}")


def answer(a: str, b: str, columns: dict[str, np.ndarray], threads: int) -> tuple[float, np.ndarray, np.ndarray]:
    """Returns the seconds that a table takes, the bits of the times of contact, and the statuses."""
    bodies = rigid_ccd.Body.from_file(a), rigid_ccd.Body.from_file(b)
    begin = time.perf_counter()
    found = rigid_ccd.first_contacts(*bodies, columns, threads=threads)
    seconds = time.perf_counter() - begin
    return seconds, found["time"].view(np.uint64), found["status"].astype(str)


if __name__ == "__main__":
    main()
