"""This project: all edges in one call from Python, and the command `ccd edges` where it is on the path."""

import csv
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Literal

import numpy as np
import rigid_ccd

from data import CHUNK, Bools, Cell, Floats, Obstacle, Robot, read_edges, read_paths
from measure import Measure, Measured, together

TOLERANCE = 1e-4  # metres
GIT = ["git", "-C", str(Path(__file__).parent), "describe", "--always", "--exclude=*", "--abbrev=8", "--dirty"]
TITLE, VERSION = "ours:", subprocess.run(GIT, capture_output=True, text=True).stdout.strip()
Meshes = Literal["hull", "exact"]


def body(obstacle: Obstacle) -> rigid_ccd.Body:
    if obstacle.mesh:
        return rigid_ccd.Body.from_file(obstacle.mesh)
    make: Callable[..., rigid_ccd.Body] = getattr(rigid_ccd.Body, obstacle.kind)
    return make(*obstacle.sizes)


def prepare(robot: Robot, cell: Cell, meshes: Meshes = "hull") -> rigid_ccd.Cell:
    prepared = rigid_ccd.Cell(rigid_ccd.Robot.from_urdf(robot.urdf, robot.srdf, meshes=meshes))
    for k, obstacle in enumerate(cell.obstacles):
        w, *xyz = obstacle.quaternion
        prepared.add_obstacle(f"{obstacle.kind} {k}", body(obstacle), (obstacle.position, [*xyz, w]))
    return prepared


def check(cell: rigid_ccd.Cell, edges: Floats) -> Bools:
    answers = cell.answer_edges(edges[:, 0], edges[:, 1], threads=1, tolerance=TOLERANCE)
    return np.array(answers["status"] == "free", np.bool_)


def command(robot: Robot, cell: Cell, joints: list[str]) -> Measure:
    """Measures `ccd edges` by its column `micros`, of each edge the median of the rounds after a first one."""

    def measure(edges: Floats, rounds: int) -> Measured:
        with tempfile.TemporaryDirectory() as folder:
            moves, obstacles, answers = (Path(folder) / name for name in ("moves.csv", "cell.toml", "answers.csv"))
            names = [f"{end}_{joint}" for end in ("from", "to") for joint in joints]
            table = np.tile(edges.reshape(len(edges), -1), (rounds + 1, 1))
            np.savetxt(moves, table, "%.17g", ",", header=",".join(names), comments="")
            obstacles.write_text("".join(as_toml(k, obstacle) for k, obstacle in enumerate(cell.obstacles)))
            files: list[str | Path] = ["--srdf", robot.srdf, "--cell", obstacles, "--edges", moves, "--out", answers]
            options = ["--meshes", "hull", "--tolerance", str(TOLERANCE), "--threads", "1", "--quiet"]
            subprocess.run(["ccd", "edges", robot.urdf, *files, *options], check=True)
            rows = list(csv.DictReader(answers.open(newline="")))
        micros = np.array([float(row["micros"]) for row in rows]).reshape(rounds + 1, -1)
        free = np.array([row["status"] == "free" for row in rows[: len(edges)]])
        return Measured(float(np.median(micros[1:], axis=0).mean()), free)

    return measure


def as_toml(k: int, obstacle: Obstacle) -> str:
    body = obstacle.mesh.absolute() if obstacle.mesh else f"{obstacle.kind}:{','.join(map(repr, obstacle.sizes))}"
    w, *xyz = obstacle.quaternion
    pose = f"position = {obstacle.position}\nquaternion_xyzw = {[*xyz, w]}"
    return f'[[obstacle]]\nname = "{obstacle.kind} {k}"\nbody = "{body}"\n{pose}\n'


def checks(robot: Robot, cell: Cell, steps: list[int]) -> Iterator[tuple[str, Measure]]:
    prepared = prepare(robot, cell)
    if shutil.which("ccd"):
        way = "ccd edges --threads 1 --tolerance 1e-4 after the first round"
        yield way, command(robot, cell, prepared.robot.joint_names)
    yield "Cell.answer_edges threads=1", together(lambda edges: check(prepared, edges))


def report(folder: Path, robot: Robot, cell: Cell, meshes: Meshes) -> None:
    """Prints how near the refused edges of a cell come, and the times of its paths by the clock."""
    prepared = prepare(robot, cell, meshes)
    for edges in read_edges(folder, robot, cell, None):
        measured = together(lambda edges: check(prepared, edges))(edges.pairs, 3)
        refused = np.flatnonzero(~measured.free & ~edges.touches)
        nearest = [prepared.closest_approach(edges.pairs[k], tolerance=1e-6).upper for k in refused]
        accepted = (measured.free & edges.touches).sum()
        wrong = f"{accepted} accepted, {len(refused)} refused at up to {max(nearest, default=0.0):.1e} m"
        print(f"{cell.name}, {edges.radians:g} rad: {measured.micros:.1f} us an edge, wrong: {wrong}")
    file = folder / f"chunks_{cell.name}.bin"
    if not file.exists():
        return
    paths = read_paths(file, robot.joints, CHUNK)
    rounds = []
    for _ in range(3):
        times = [time.perf_counter()]
        for path in paths:
            prepared.is_free(path, tolerance=TOLERANCE)
            times.append(time.perf_counter())
        rounds.append(np.diff(times))
    for name, each in {"first round": rounds[0], "median of 3 rounds": np.median(rounds, axis=0)}.items():
        median, p99 = 1e3 * np.quantile(each, [0.5, 0.99])
        print(f"{cell.name}, paths of {CHUNK} configurations, {name}: median {median:.3f} ms, p99 {p99:.3f} ms")
