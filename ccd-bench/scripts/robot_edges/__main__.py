#!/usr/bin/env python3
"""Makes the table of edges of a robot: microseconds an edge, and edges accepted or refused wrongly, of many programs.

    python ccd-bench/scripts/robot_edges measure DATA --csv edges.csv [--peer mujoco --steps 20]
    python ccd-bench/scripts/robot_edges table edges.csv
    python ccd-bench/scripts/robot_edges ours DATA

`measure` asks each program that is installed, or the one that is named, and adds rows to the table. Programs that need
different versions of Python add to the same table. `table` makes Markdown of it. `ours` prints what only this project
says: how near the refused edges come, and the times of paths. data.py describes the folder DATA. Pin the process to a
core: `taskset -c 1`.
"""

import argparse
import csv
import importlib
import subprocess
import sys
from pathlib import Path

from data import Cell, Edges, read_cell, read_edges, read_robot
from measure import Measured
from peers import INSTALL

COLUMNS = ["program", "version", "cell", "radians", "edges", "us_an_edge", "touch_but_accepted", "apart_but_refused"]
Row = dict[str, str]


def row(program: str, release: str, edges: Edges, measured: Measured) -> Row:
    accepted, refused = measured.free & edges.touches, ~measured.free & ~edges.touches
    counts = [len(edges.touches), f"{measured.micros:.1f}", accepted.sum(), refused.sum()]
    values = [program, release, edges.cell.name, f"{edges.radians:g}", *counts]
    return dict(zip(COLUMNS, map(str, values), strict=True))


def cells(given: argparse.Namespace) -> list[Cell]:
    folders = [given.data, *([given.meshes] if given.meshes else [])]
    names = given.cells or sorted({file.stem.split("_")[1] for file in given.data.glob("edges_*.bin")})
    return [read_cell(given.data / f"{name}.txt", folders) for name in names]


def measure(given: argparse.Namespace) -> None:
    """Asks one program, or each in a process of its own, so that none changes or ends another."""
    if not given.peer:
        for name in INSTALL:
            subprocess.run([sys.executable, *sys.argv, "--peer", name])
        return
    try:
        peer = importlib.import_module(f"peers.{given.peer}")
    except ImportError as error:
        print(f"{given.peer} is left out, {error}: {INSTALL[given.peer]}")
        return
    robot = read_robot(given.data)
    if not given.csv.exists():
        given.csv.write_text(",".join(COLUMNS) + "\n")
    for cell in cells(given):
        for way, check in peer.checks(robot, cell, given.steps):
            for edges in read_edges(given.data, robot, cell, given.edges):
                new = row(f"{peer.TITLE} {way}", peer.VERSION, edges, check(edges.pairs, given.rounds))
                with given.csv.open("a", newline="") as file:
                    csv.DictWriter(file, COLUMNS, lineterminator="\n").writerow(new)
                print(*new.values(), flush=True)


def figure(row: Row, most: int) -> str:
    """Returns the time, and in brackets the edges accepted and refused wrongly, of how many if not of the most."""
    micros = float(row["us_an_edge"])
    time = f"{micros:.1f}" if micros < 9.95 else f"{micros:,.0f}"
    asked = f" of {row['edges']}" if int(row["edges"]) < most else ""
    wrong = f" ({row['touch_but_accepted']}, {row['apart_but_refused']}{asked})"
    return time + (wrong if row["touch_but_accepted"] else "")


def table(given: argparse.Namespace) -> None:
    """Prints a line for each program and a column for each file of edges; the last row of a kind counts."""
    rows = [row for file in given.csv for row in csv.DictReader(file.open(newline=""))]
    columns = sorted({(row["cell"], float(row["radians"])) for row in rows})
    most = max(int(row["edges"]) for row in rows)
    lines: dict[str, dict[tuple[str, float], str]] = {}
    for row in rows:
        line = lines.setdefault(f"{row['program']} ({row['version']})" if row["version"] else row["program"], {})
        line[row["cell"], float(row["radians"])] = figure(row, most)
    print("| |", " | ".join(f"{cell}, {radians:g}" for cell, radians in columns), "|")
    print("|---" * (len(columns) + 1) + "|")
    for program, line in lines.items():
        print("|", " | ".join([program, *(line.get(column, "") for column in columns)]), "|")


def ours(given: argparse.Namespace) -> None:
    from peers.ours import report

    robot = read_robot(given.data)
    for cell in cells(given):
        report(given.data, robot, cell, "exact" if given.exact else "hull")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)

    asking = argparse.ArgumentParser(add_help=False)
    asking.add_argument("data", type=Path, help="a folder with a robot, cells, edges and answers")
    asking.add_argument("--meshes", type=Path, help="a further folder of meshes of cells")
    asking.add_argument("--cells", nargs="+", help="names of cells [default: all that have edges]")

    command = commands.add_parser("measure", parents=[asking], help="ask programs, and add rows to a table")
    command.set_defaults(run=measure)
    command.add_argument("--csv", type=Path, required=True, help="the table to add to")
    command.add_argument("--peer", choices=INSTALL, help="a program [default: all that are installed]")
    command.add_argument("--steps", type=int, nargs="+", default=[5, 20], help="of programs that test configurations")
    command.add_argument("--edges", type=int, help="so many of each file [default: all]")
    command.add_argument("--rounds", type=int, default=3, help="the median of so many rounds counts")

    command = commands.add_parser("table", help="make Markdown of tables")
    command.set_defaults(run=table)
    command.add_argument("csv", type=Path, nargs="+")

    command = commands.add_parser("ours", parents=[asking], help="what only this project says")
    command.set_defaults(run=ours)
    command.add_argument("--exact", action="store_true", help="meshes of links as they are, instead of their hulls")

    given = parser.parse_args()
    given.run(given)


if __name__ == "__main__":
    main()
