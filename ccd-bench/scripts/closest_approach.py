#!/usr/bin/env python3
"""Checks `ccd query --ask closest-approach` against dense sampling with Coal's distances, and local refinement.

usage: closest_approach.py SCENES [OUT] [--samples N] [--rows N]
  SCENES   folder with meshes (*.obj) and motions (*.csv)
  OUT      folder for the results of `ccd`, a new one by default
  CCD      (environment) the command, by default the one of this clone, built with --release

For each row it measures the bodies at equal steps, and about the least of these distances again and again. A row
is wrong if a distance is below the lower bound, if the distance at the reported time is above the upper bound, or
if the bounds are farther apart than the tolerance. Poses are computed here.

Columns: the pair; its rows, and how many of these keep apart; wrong rows; the largest width of the bounds; the
least and the largest of (least sampled distance - lower bound) where the bodies keep apart.
"""
import argparse
import csv
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import peers
from cost import pairs

TOLERANCE = 1e-3
# The rounding of distances and poses at coordinates of some units.
ROUNDING = 1e-9
# The number of least samples that are refined, and the number of evaluations for each.
REFINED, LOOKS = 3, 24


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", type=Path, metavar="SCENES")
    parser.add_argument("out", type=Path, nargs="?", metavar="OUT")
    parser.add_argument("--samples", type=int, default=100)
    parser.add_argument("--rows", type=int, help="only the first ROWS rows of each pair")
    options = parser.parse_args()
    out = options.out or Path(tempfile.mkdtemp())
    out.mkdir(parents=True, exist_ok=True)
    default = Path(__file__).parents[2] / "target/release/ccd"
    ccd = os.environ.get("CCD", str(default))
    print("pair,rows,apart,wrong,largest_width,least_slack,largest_slack", flush=True)
    wrong = 0
    for _, a, b, motions in pairs():
        wrong += check(ccd, options, out, a, b, motions)
    sys.exit(wrong > 0)


def check(ccd, options, out, a, b, motions):
    """Checks the rows of a pair, and returns the number of wrong ones."""
    files = [options.scenes / f"{a}.obj", options.scenes / f"{b}.obj"]
    table = options.scenes / f"{motions}.csv"
    results = out / f"{a}-closest.csv"
    command = [ccd, "query", "--quiet", "--a", files[0], "--b", files[1], "--motions", table]
    command += ["--ask", "closest-approach", "--tolerance", str(TOLERANCE), "--out", results]
    if options.rows:
        command += ["--rows", f"0..{options.rows}"]
    subprocess.run(command, check=True)
    bodies = peers.Coal(*(peers.read_obj(file) for file in files))
    rows, found = peers.read_motions(table), list(csv.DictReader(results.open()))
    wrong, apart, widths, slacks = 0, 0, [], []
    for row, answer in zip(rows, found):
        query = peers.Query(row, bodies.reach)
        lower, upper = float(answer["distance_lower"]), float(answer["distance_upper"])
        when = float(answer["time"])
        least = sampled(lambda time: separation(bodies, query, time), query.duration, options.samples)
        there = separation(bodies, query, when)
        bad = least < lower - ROUNDING or there > upper + ROUNDING
        if answer["status"] == "measured" and lower > 0:
            apart += 1
            widths.append(upper - lower)
            slacks.append(least - lower)
        # Bodies that meet have a least distance of 0, with the bounds of the first contact found.
        bad |= answer["status"] not in ("measured", "overlapping") or max(lower, 0) + TOLERANCE * (1 + 1e-9) < upper
        if bad:
            wrong += 1
            print(f"{a} row {answer['id']}: {lower} {upper} at {when}, but {least}; there {there}", file=sys.stderr)
    numbers = [max(widths, default=0), min(slacks, default=0), max(slacks, default=0)]
    print(",".join([a, str(len(found)), str(apart), str(wrong), *(f"{x:.3e}" for x in numbers)]), flush=True)
    return wrong


def separation(bodies, query, when):
    """Returns the distance of the surfaces at a time; 0 if they intersect."""
    a, b = bodies.pose(query.a, when), bodies.pose(query.b, when)
    request, result = bodies.coal.DistanceRequest(), bodies.coal.DistanceResult()
    return max(0.0, bodies.coal.distance(bodies.a, a, bodies.b, b, request, result))


def sampled(distance, duration, samples):
    """Returns the least distance at equal steps, and of a ternary search around the least ones."""
    times = [duration * k / samples for k in range(samples + 1)]
    seen = [(distance(time), time) for time in times]
    least = min(seen)[0]
    for _, time in sorted(seen)[:REFINED]:
        low, high = max(0.0, time - duration / samples), min(duration, time + duration / samples)
        for _ in range(LOOKS // 2):
            thirds = [low + (high - low) / 3, high - (high - low) / 3]
            left, right = (distance(time) for time in thirds)
            least = min(least, left, right)
            low, high = (low, thirds[1]) if left < right else (thirds[0], high)
    return least


if __name__ == "__main__":
    main()
