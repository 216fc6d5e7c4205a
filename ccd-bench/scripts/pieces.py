"""Compares the times of queries over each kind of pieces with the choice of `auto`: one run, one table.

    python3 ccd-bench/scripts/pieces.py target/release/ccd [--meshes FOLDER --pairs N --seed S]

Measures icospheres of 320 to 81,920 triangles against a torus of 4,096 and against each other; with
--meshes, also random pairs of the folder's meshes. Every pair makes three motions. A row has, per kind, the
mean over the motions of the median time of a query, in microseconds; then the ratio of auto's time to the
least of them. It needs Python with trimesh.
"""

import argparse
import csv
import math
import random
import subprocess
import tempfile
from pathlib import Path

from trimesh.creation import icosphere, torus

KINDS = ["auto", "triangles", "patches", "hull"]


def extent(ccd, mesh, folder):
    """Returns the middle and half the diagonal of a mesh's box, from the pieces that the program writes."""
    out = folder / "extent.obj"
    run = subprocess.run([ccd, "decompose", mesh, "--pieces", "triangles", "--out", out], capture_output=True)
    if run.returncode != 0:
        return None
    points = [list(map(float, line.split()[1:4])) for line in out.open() if line.startswith("v ")]
    low, high = [min(c) for c in zip(*points)], [max(c) for c in zip(*points)]
    return [(l + h) / 2 for l, h in zip(low, high)], math.dist(low, high) / 2


COLUMNS = ["id", "a_px", "a_py", "a_pz", "a_cx", "a_cy", "a_cz", "a_vx", "a_vy", "a_vz", "a_wx", "a_wy", "a_wz"]


def motions(path, rows):
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        table.writerows([k, *row] for k, row in enumerate(rows))
    return path


def towards(rng, a, b):
    """Returns motions that start outside the other body and pass through it, with a rotation about the body's middle."""
    (middle_a, size_a), (middle_b, size_b) = a, b
    rows = []
    for _ in range(3):
        way = [rng.gauss(0, 1) for _ in range(3)]
        way = [x / math.hypot(*way) for x in way]
        far = 1.2 * (size_a + size_b)
        start = [m + far * w - c for m, w, c in zip(middle_b, way, middle_a)]
        aim = [0.3 * rng.uniform(-1, 1) * size_b for _ in range(3)]
        rows.append([*start, *middle_a, *[2 * (x - far * w) for x, w in zip(aim, way)]]
                    + [rng.uniform(-1.5, 1.5) for _ in range(3)])
    return rows


def prepared(ccd, mesh, kind, folder):
    """Returns the mesh as pieces of this kind, or None if that is impossible."""
    out = folder / f"{mesh.stem}.{kind}.ccd"
    if not out.exists():
        subprocess.run([ccd, "decompose", mesh, "--pieces", kind, "--out", out], capture_output=True)
    return out if out.exists() else None


def measure(ccd, a, b, table, tolerance, repeat, folder):
    out = folder / "out.csv"
    command = [ccd, "query", "--a", a, "--b", b, "--motions", table, "--tolerance", str(tolerance)]
    run = subprocess.run([*command, "--repeat", str(repeat), "--threads", "1", "--out", out], capture_output=True)
    if run.returncode != 0:
        raise SystemExit(run.stderr.decode())
    rows = list(csv.DictReader(out.open()))
    mean = lambda column: sum(float(row[column]) for row in rows) / len(rows)
    return mean("micros"), mean("iterations"), mean("oracle_calls")


def line(ccd, name, a, b, table, tolerance, options, folder):
    found = {}
    for kind in KINDS:
        of_a, of_b = prepared(ccd, a, kind, folder), prepared(ccd, b, kind, folder)
        if kind == "hull":
            # The hull of only one of the bodies is measured as well.
            of_b = of_b or (of_a and prepared(ccd, b, "triangles", folder))
            of_a = of_a or (of_b and prepared(ccd, a, "triangles", folder))
        if of_a and of_b:
            found[kind] = measure(ccd, of_a, of_b, table, tolerance, options.repeat, folder)
    best = min(micros for micros, _, _ in found.values())
    ratio = found["auto"][0] / best
    cells = ["%9.1f" % found[kind][0] if kind in found else "        -" for kind in KINDS]
    counts = "%6.0f %5.0f" % found["auto"][1:]
    print(f"{name:44}", *cells, counts, "%5.2f" % ratio, flush=True)
    return ratio


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ccd", type=Path)
    parser.add_argument("--meshes", type=Path)
    parser.add_argument("--pairs", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--repeat", type=int, default=9)
    options = parser.parse_args()
    ccd = options.ccd.resolve()
    print(f"{'pair':44}", *[f"{kind:>9}" for kind in KINDS], "visits calls  ratio")
    ratios = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ring = folder / "torus4096.obj"
        torus(1.0, 0.4, major_sections=64, minor_sections=32).export(ring, digits=17)
        balls = [folder / f"ball{20 * 4**k}.obj" for k in range(2, 7)]
        for k, ball in enumerate(balls, 2):
            icosphere(k).export(ball, digits=17)
        passing = [[-4, 0, 0, 0, 0, 0, v, 0, 0, *w] for v, w in [(5, (0, 0, 1)), (4, (0.5, 1, 0)), (3, (1, 0, 2))]]
        table = motions(folder / "passing.csv", passing)
        for ball in balls:
            for other in [ring, ball]:
                pair = f"{ball.stem} {other.stem}"
                ratios.append(line(ccd, pair, ball, other, table, 1e-3, options, folder))
        rng = random.Random(options.seed)
        meshes = sorted(p for p in options.meshes.rglob("*") if p.suffix.lower() in (".stl", ".obj")) if options.meshes else []
        done = 0
        while meshes and done < options.pairs:
            a, b = rng.choice(meshes), rng.choice(meshes)
            extents = [extent(ccd, mesh, folder) for mesh in (a, b)]
            if None in extents:
                continue
            # File names are not unique in the folder.
            copies = []
            for mesh in (a, b):
                copy = folder / f"{meshes.index(mesh)}_{mesh.name}"
                copy.write_bytes(mesh.read_bytes())
                copies.append(copy)
            table = motions(folder / "towards.csv", towards(rng, *extents))
            tolerance = 1e-3 * min(size for _, size in extents)
            pair = f"{a.stem[:21]} {b.stem[:21]}"
            ratios.append(line(ccd, pair, *copies, table, tolerance, options, folder))
            done += 1
    over = sum(ratio > 1.2 for ratio in ratios)
    print(f"{len(ratios)} lines, {over} over 1.2, worst {max(ratios):.2f}")


main()
