#!/usr/bin/env python3
"""Certifies edges of arms whose answers are known: time an edge, edges accepted or refused wrongly.

    arms.py DATA [DATA ...] [--meshes FOLDER] [--exact] [--rounds 3]

Each folder DATA has NAME.urdf and NAME.srdf, and for each cell, such as A: A.txt with a body in each line (`box` and
half extents, `sphere` and radius, `capsule` with radius and half length, or `mesh` and the name of an OBJ file), then
its pose as x y z and a quaternion w x y z; edges_A_LENGTH.bin with pairs of configurations of float64; and
truth_A_LENGTH.txt, whose lines begin with 1 for an edge that touches. chunks_A.bin has paths of 50 configurations.
Run it with `taskset -c 1`. It needs the package `rigid_ccd` and NumPy.
"""

import argparse
import statistics
import time
from pathlib import Path

import numpy as np

from rigid_ccd import Body, Cell, Robot

TOLERANCE = 1e-4  # metres
CHUNK = 50  # configurations of a path


def body(kind: str, sizes: list[str], folders: list[Path]) -> Body:
    match kind:
        case "box":
            return Body.box(*map(float, sizes))
        case "sphere":
            return Body.sphere(float(sizes[0]))
        case "capsule":
            return Body.capsule(float(sizes[0]), float(sizes[1]))
    file = next(path for folder in folders if (path := folder / f"{sizes[0]}.obj").exists())
    return Body.from_file(file)


def read_cell(robot: Robot, file: Path, folders: list[Path]) -> Cell:
    cell = Cell(robot)
    for k, line in enumerate(file.read_text().splitlines()):
        kind, *rest = line.split()
        pose = [float(number) for number in rest[-7:]]
        cell.add(f"{kind} {k}", body(kind, rest[:-7], folders), (pose[:3], pose[3:]))
    return cell


def configurations(file: Path, joints: int, count: int) -> np.ndarray:
    """Returns paths of `count` configurations; joints that the file leaves out are at 0."""
    numbers = np.fromfile(file)
    given = joints if numbers.size % (count * joints) == 0 else joints - 1
    paths = numbers.reshape(-1, count, given)
    return np.concatenate([paths, np.zeros((*paths.shape[:2], joints - given))], axis=2)


def report(cell: Cell, edges_file: Path, rounds: int) -> None:
    edges = configurations(edges_file, len(cell.robot.joint_names), 2)
    truth_file = edges_file.with_name(edges_file.stem.replace("edges", "truth") + ".txt")
    touches = np.array([line.startswith("1") for line in truth_file.read_text().splitlines()])
    times = []
    for _ in range(rounds):
        began = time.process_time()
        free = cell.edges(edges[:, 0], edges[:, 1], threads=1, tolerance=TOLERANCE)["status"] == "free"
        times.append((time.process_time() - began) / len(edges))
    refused = np.flatnonzero(~free & ~touches)
    nearest = max((cell.closest_approach(edges[k], tolerance=1e-6).upper for k in refused), default=0)
    print(
        f"{edges_file.stem:16} {1e6 * statistics.median(times):8.1f} {free.sum():6}"
        f" {(free & touches).sum():15} {len(refused):15} {nearest:14.1e}"
    )


def report_chunks(cell: Cell, file: Path) -> None:
    paths = configurations(file, len(cell.robot.joint_names), CHUNK)
    times = []
    for path in paths:
        began = time.perf_counter()
        cell.is_free(path, tolerance=TOLERANCE)
        times.append(1e3 * (time.perf_counter() - began))
    median, p99 = np.quantile(times, [0.5, 0.99])
    print(f"{file.stem:16} paths of {CHUNK} configurations: median {median:.3f} ms, p99 {p99:.3f} ms")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", nargs="+", type=Path, help="a folder with a robot, cells, edges and answers")
    parser.add_argument("--meshes", type=Path, help="a further folder of meshes of cells")
    parser.add_argument("--exact", action="store_true", help="meshes of links as they are, instead of their hulls")
    parser.add_argument("--rounds", type=int, default=3, help="the median of so many rounds is reported")
    given = parser.parse_args()
    print("edges            us an edge   free    touch but free   apart but not  their distance")
    for folder in given.data:
        urdf = next(folder.glob("*.urdf"))
        meshes = "exact" if given.exact else "hull"
        robot = Robot.from_urdf(urdf, urdf.with_suffix(".srdf"), meshes=meshes)
        folders = [folder, *([given.meshes] if given.meshes else [])]
        for file in sorted(folder.glob("edges_*.bin")):
            name = file.stem.split("_")[1]
            report(read_cell(robot, folder / f"{name}.txt", folders), file, given.rounds)
        for file in sorted(folder.glob("chunks_*.bin")):
            name = file.stem.split("_")[1]
            report_chunks(read_cell(robot, folder / f"{name}.txt", folders), file)


if __name__ == "__main__":
    main()
