#!/usr/bin/env python3
"""Answers queries with Coal and FCL, through their Python packages, as `ccd-bench answer` does.

    peers.py answer --method fcl-ca --a A.obj --b B.obj --tolerance 1e-3

It is for `--peers` of `ccd-bench chart`, `stability` and `judge`, which stop it at a time limit. It writes `ready`,
or `refused: ` and a reason; then it reads a line for each query, and writes one for each reply, both in
JSON as in `src/method/wire.rs`. Methods:

  coal-distance  one static distance at the start, the least cost of any method, which claims nothing
  coal-steps     static collision tests at equal steps, such that no point moves farther than the tolerance
                 in a step. It reports the first test that collides, so contacts are late by up to a step,
                 and grazing contacts are missed. There are at most CAP tests: longer motions have
                 longer steps
  fcl-ca         FCL's continuousCollide, conservative advancement
  fcl-naive      FCL's continuousCollide, tests at equal steps, as many as for coal-steps

FCL moves a body as `ccd` does: with CCDM_LINEAR its origin moves straight, and the body turns about it at a
constant rate, the shorter way. The meshes are therefore shifted so that their origin is the center of
rotation, and motions are cut into stretches of less than half a turn. FCL's screws are other motions, and its
splines take no poses. Its meshes are BVHs of OBBRSS, the only kind that the package makes. Ray shooting is
not implemented for them, and the polynomial solver needs vertices of two frames and changes the meshes.
`toc_err` is a fraction of the stretch: the tolerance over a bound of the travel of all points.

Known faults of fcl-ca on meshes: boxes that fall flat onto each other are reported free (the bounds of two
motions are added with their signs, so that they cancel), and contacts of turning boxes are early. `toc_err`
does not change this. Apart from their steps, coal-steps and fcl-naive have no known faults.

`micros` is the time of the calls alone, including Python's overhead (about a microsecond per call). `steps` counts
tests, or stretches for fcl-ca. `time` is in the motion's unit of time.
"""
import argparse
import json
import math
import sys
import time
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

METHODS = ["coal-distance", "coal-steps", "fcl-ca", "fcl-naive"]
# The largest number of tests of a query.
CAP = 100_000
# The largest rotation of a segment, because FCL rotates the shorter way.
LONGEST_TURN = 0.9 * math.pi


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=["answer"])
    parser.add_argument("--method", choices=METHODS, required=True)
    parser.add_argument("--a", type=Path, required=True, metavar="MESH")
    parser.add_argument("--b", type=Path, required=True, metavar="MESH")
    parser.add_argument("--tolerance", type=float, required=True, metavar="LENGTH")
    parser.add_argument("--margin", type=float, default=0, metavar="LENGTH")
    options = parser.parse_args()
    if options.margin:
        print("refused: the method keeps no margin", flush=True)
        return
    bodies, ask = opened(options.method, options.a, options.b)
    print("ready", flush=True)
    for line in sys.stdin:
        micros, steps, claim = ask(bodies, json.loads(line), options.tolerance)
        reply = {"claim": claim, "steps": steps, "tolerance": None, "reason": None}
        print(json.dumps({"reply": reply, "micros": micros}), flush=True)


def opened(method, a, b):
    """Returns the bodies of a method, and the function that answers queries about them."""
    ask = {
        "coal-distance": Coal.distance,
        "coal-steps": Coal.steps,
        "fcl-ca": Fcl.advance,
        "fcl-naive": Fcl.sample,
    }[method]
    library = Coal if method.startswith("coal") else Fcl
    return library(read_obj(a), read_obj(b)), ask


class Motion:
    """A motion: the center has a constant velocity, and the body rotates about it at a constant rate."""

    def __init__(self, numbers):
        position, quaternion, self.velocity, self.spin, self.center = np.split(np.array(numbers), [3, 7, 10, 13])
        self.rotation = Rotation.from_quat(quaternion)
        self.start = position + self.rotation.apply(self.center)

    def at(self, when):
        """Returns the rotation and the position of the center."""
        return Rotation.from_rotvec(self.spin * when) * self.rotation, self.start + when * self.velocity


class Query:
    """The motions of a row, and a bound on the displacement of any point towards the other body."""

    def __init__(self, row, reach):
        *motions, self.duration = row
        self.a, self.b = map(Motion, motions)
        turning = sum(
            np.linalg.norm(motion.spin) * radius(motion.center)
            for motion, radius in zip((self.a, self.b), reach)
        )
        self.way = (np.linalg.norm(self.a.velocity - self.b.velocity) + turning) * self.duration

    def tests(self, tolerance):
        """Returns the number of steps that move no point by more than the tolerance."""
        return int(min(max(math.ceil(self.way / tolerance), 1), CAP))


class Coal:
    def __init__(self, a, b):
        import coal

        self.coal = coal
        self.reach = [reach_of(vertices) for vertices, _ in (a, b)]
        self.a, self.b = self.model(*a), self.model(*b)

    def model(self, vertices, faces):
        model = self.coal.BVHModelOBBRSS()
        model.beginModel(len(faces), len(vertices))
        points, triangles = self.coal.StdVec_Vec3s(), self.coal.StdVec_Triangle()
        for vertex in vertices:
            points.append(vertex)
        for face in faces:
            triangles.append(self.coal.Triangle(*(int(k) for k in face)))
        model.addSubModel(points, triangles)
        model.endModel()
        return model

    def pose(self, motion, when):
        rotation, center = motion.at(when)
        turn = rotation.as_matrix()
        return self.coal.Transform3s(turn, center - turn @ motion.center)

    def distance(self, row, _tolerance):
        query = Query(row, self.reach)
        a, b = self.pose(query.a, 0), self.pose(query.b, 0)
        request, result = self.coal.DistanceRequest(), self.coal.DistanceResult()
        begin = time.perf_counter()
        self.coal.distance(self.a, a, self.b, b, request, result)
        return (time.perf_counter() - begin) * 1e6, 1, "other-measurement"

    def steps(self, row, tolerance):
        query = Query(row, self.reach)
        count = query.tests(tolerance)
        request, spent = self.coal.CollisionRequest(), 0.0
        for k in range(count + 1):
            when = query.duration * k / count
            a, b = self.pose(query.a, when), self.pose(query.b, when)
            result = self.coal.CollisionResult()
            begin = time.perf_counter()
            hit = self.coal.collide(self.a, a, self.b, b, request, result)
            spent += time.perf_counter() - begin
            if hit:
                return spent * 1e6, k + 1, {"contact": {"time": when}}
        return spent * 1e6, count + 1, "no-contact"


class Fcl:
    def __init__(self, a, b):
        import fcl

        self.fcl = fcl
        self.meshes = [a, b]
        self.reach = [reach_of(vertices) for vertices, _ in (a, b)]
        self.models = {}

    def model(self, k, center):
        """Returns the mesh with the center as its origin, made once for each center."""
        key = (k, *center)
        if key not in self.models:
            vertices, faces = self.meshes[k]
            model = self.fcl.BVHModel()
            model.beginModel(len(vertices), len(faces))
            model.addSubModel(vertices - center, faces)
            model.endModel()
            self.models[key] = model
        return self.models[key]

    def transform(self, motion, when):
        rotation, center = motion.at(when)
        return self.fcl.Transform(rotation.as_quat(scalar_first=True), center)

    def advance(self, row, tolerance):
        return self.collide(row, tolerance, self.fcl.CCDSolverType.CCDC_CONSERVATIVE_ADVANCEMENT)

    def sample(self, row, tolerance):
        return self.collide(row, tolerance, self.fcl.CCDSolverType.CCDC_NAIVE)

    def collide(self, row, tolerance, solver):
        query = Query(row, self.reach)
        motions = [query.a, query.b]
        turn = max(np.linalg.norm(motion.spin) for motion in motions) * query.duration
        stretches = max(1, math.ceil(turn / LONGEST_TURN))
        tests = max(1, math.ceil(query.tests(tolerance) / stretches))
        request = self.fcl.ContinuousCollisionRequest(
            num_max_iterations=tests,
            toc_err=1.0 / tests,
            ccd_motion_type=self.fcl.CCDMotionType.CCDM_LINEAR,
            ccd_solver_type=solver,
        )
        advances = solver == self.fcl.CCDSolverType.CCDC_CONSERVATIVE_ADVANCEMENT
        spent = 0.0
        for k in range(stretches):
            ends = [query.duration * (k + j) / stretches for j in (0, 1)]
            first, last = ([self.transform(m, when) for m in motions] for when in ends)
            a, b = (
                self.fcl.CollisionObject(self.model(j, motions[j].center), first[j]) for j in (0, 1)
            )
            result = self.fcl.ContinuousCollisionResult()
            begin = time.perf_counter()
            self.fcl.continuousCollide(a, last[0], b, last[1], request, result)
            spent += time.perf_counter() - begin
            if result.is_collide:
                when = ends[0] + result.time_of_contact * (ends[1] - ends[0])
                steps = k + 1 if advances else round((k + result.time_of_contact) * tests) + 1
                return spent * 1e6, steps, {"contact": {"time": when}}
        return spent * 1e6, stretches if advances else stretches * tests + 1, "no-contact"


def read_obj(path):
    """Reads a mesh as `ccd-bench` writes it: triangles, by the numbers of their vertices."""
    rows = [line.split() for line in path.open()]
    vertices = np.array([row[1:] for row in rows if row[0] == "v"], float)
    return vertices, np.array([row[1:] for row in rows if row[0] == "f"], int) - 1


def reach_of(vertices):
    """Returns a bound of the distance of the body's points from a center."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return lambda center: np.linalg.norm(np.maximum(abs(low - center), abs(high - center)))


if __name__ == "__main__":
    main()
