"""Times the first contact of each row, and one static distance and one discrete check of FCL and Coal.

    pip install python-fcl coal trimesh
    python bench/peers.py A.obj B.obj motions.csv

Peers answer at the start pose of each row: what a user would call a thousand times to step along the motion once. All
run on one thread. Each number is in microseconds, of one call from Python; those of the table are its column `micros`.
"""

import argparse
import csv
import statistics
import time
from collections.abc import Callable
from typing import Any

import coal
import fcl
import numpy as np
import trimesh

import rigid_ccd


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a")
    parser.add_argument("b")
    parser.add_argument("motions")
    parser.add_argument("--rows", type=int, default=None, help="the first rows alone")
    given = parser.parse_args()
    with open(given.motions, newline="") as file:
        rows = list(csv.DictReader(file))[: given.rows]
    meshes = [trimesh.load(path, process=False) for path in (given.a, given.b)]
    bodies = [rigid_ccd.Body.from_trimesh(mesh) for mesh in meshes]
    starts = [[pose(row, side, "") for row in rows] for side in "ab"]
    ends = [[pose(row, side, "end_") for row in rows] for side in "ab"]
    motions = [
        [rigid_ccd.Motion.between(start, end) for start, end in zip(*both, strict=True)]
        for both in zip(starts, ends, strict=True)
    ]

    taken: dict[str, list[float]] = {}
    ours = lambda k: rigid_ccd.first_contact(*bodies, motions[0][k], motions[1][k])  # noqa: E731
    ours_still = lambda k: rigid_ccd.distance(*bodies, starts[0][k], starts[1][k])  # noqa: E731
    ways: dict[str, Callable[[int], Any]] = {
        "ours, first contact": ours,
        "ours, distance at rest": ours_still,
        **of_fcl(meshes, starts),
        **of_coal(meshes, starts),
    }
    found: dict[str, list[Any]] = {name: [] for name in ways}
    for k in range(len(rows)):
        for name, ask in ways.items():
            begin = time.perf_counter()
            found[name].append(ask(k))
            taken.setdefault(name, []).append(1e6 * (time.perf_counter() - begin))
    columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name != "id"}
    table = rigid_ccd.first_contacts(*bodies, columns, threads=1)
    taken["ours, first contacts of a table"] = table["micros"].tolist()

    agree(found)
    hits = int((table["status"] == "contact").sum())
    print(f"{len(rows)} rows, {hits} with a contact\n{'':32} median µs  over ours    mean µs  over ours")
    for name, times in taken.items():
        cells = []
        for average in (statistics.median, statistics.mean):
            cells += [f"{average(times):9.1f}  {average(times) / average(taken['ours, first contact']):9.2f}"]
        print(f"{name:32} {'  '.join(cells)}")


def pose(row: dict[str, str], side: str, end: str) -> Any:
    """Returns a pose of a row as a position and a quaternion."""
    names = [f"{side}_{end}{part}" for part in ("px", "py", "pz", "qw", "qx", "qy", "qz")]
    if names[0] not in row:
        return pose(row, side, "")
    numbers = [float(row[name]) for name in names]
    return numbers[:3], numbers[3:]


def of_fcl(meshes: list[Any], starts: list[list[Any]]) -> dict[str, Callable[[int], Any]]:
    models = []
    for mesh in meshes:
        model = fcl.BVHModel()
        model.beginModel(len(mesh.vertices), len(mesh.faces))
        model.addSubModel(np.asarray(mesh.vertices), np.asarray(mesh.faces))
        model.endModel()
        models.append(fcl.CollisionObject(model))
    poses = [[fcl.Transform(np.array(q), np.array(p)) for p, q in side] for side in starts]

    def at(k: int) -> None:
        for model, side in zip(models, poses, strict=True):
            model.setTransform(side[k])

    def distance(k: int) -> float:
        at(k)
        return float(fcl.distance(*models, fcl.DistanceRequest(), fcl.DistanceResult()))

    def collide(k: int) -> bool:
        at(k)
        return bool(fcl.collide(*models, fcl.CollisionRequest(), fcl.CollisionResult()))

    return {"FCL, static distance": distance, "FCL, discrete check": collide}


def of_coal(meshes: list[Any], starts: list[list[Any]]) -> dict[str, Callable[[int], Any]]:
    models = []
    for mesh in meshes:
        model = coal.BVHModelOBBRSS()
        model.beginModel(len(mesh.faces), len(mesh.vertices))
        vertices, faces = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
        for vertex in mesh.vertices:
            vertices.append(np.array(vertex))
        for face in mesh.faces:
            faces.append(coal.Triangle(*(int(corner) for corner in face)))
        model.addSubModel(vertices, faces)
        model.endModel()
        models.append(model)
    poses = [[coal.Transform3s(coal.Quaternion(*q).matrix(), np.array(p)) for p, q in side] for side in starts]

    def distance(k: int) -> float:
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        return float(coal.distance(models[0], poses[0][k], models[1], poses[1][k], request, result))

    def collide(k: int) -> bool:
        request, result = coal.CollisionRequest(), coal.CollisionResult()
        return bool(coal.collide(models[0], poses[0][k], models[1], poses[1][k], request, result))

    return {"Coal, static distance": distance, "Coal, discrete check": collide}


def agree(found: dict[str, list[Any]]) -> None:
    """Compares the distances of both peers with our brackets."""
    worst = 0.0
    for ours, *others in zip(
        found["ours, distance at rest"], found["FCL, static distance"], found["Coal, static distance"], strict=True
    ):
        for other in others:
            off = max(ours.lower - other, other - ours.upper, 0.0)
            worst = max(worst, off / max(1.0, ours.upper))
    assert worst < 1e-6, f"a distance of a peer is outside of ours by {worst}"
    print(f"distances of peers are within our bounds, up to {worst:.1e}")


if __name__ == "__main__":
    main()
