#!/usr/bin/env python3
"""Answers queries with Coal and FCL, through their Python packages, as `ccd-bench answer` does.

    peers.py answer --method fcl-ca --a A.obj --b B.obj --tolerance 1e-3

It is for `--peers` of `ccd-bench chart`, `stability` and `judge`, which stop it at a time limit. It writes `ready`,
or `refused: ` and a reason; then it reads a line of 33 numbers for each query, and writes a line of
time,status,steps,micros and two empty cells. Methods:

  coal-distance  one static distance at the start, the least cost of any method; the status is `static`
  coal-steps     static collision tests at equal steps, such that no point moves farther than the tolerance
                 in a step. It reports the first test that collides, so contacts are late by up to a step,
                 and grazing contacts are missed. There are at most CAP tests: longer motions have
                 longer steps
  fcl-ca         FCL's continuousCollide, conservative advancement
  fcl-naive      FCL's continuousCollide, tests at equal steps, as many as for coal-steps

FCL moves a body as `ccd` does: with CCDM_LINEAR its origin moves straight, and the body turns about it at a
constant rate, the shorter way. The meshes are therefore shifted so that their origin is the centre of
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
import math
import sys
import time
from pathlib import Path

import numpy as np

METHODS = ["coal-distance", "coal-steps", "fcl-ca", "fcl-naive"]
# The count of numbers for a motion on a line of standard input.
COLUMNS = "px py pz qx qy qz qw vx vy vz wx wy wz cx cy cz"
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
    columns = [f"{letter}_{name}" for letter in "ab" for name in COLUMNS.split()] + ["duration"]
    for line in sys.stdin:
        row = dict(zip(columns, line.split()))
        micros, steps, status, when = ask(bodies, row, options.tolerance)
        print(f"{when or 0},{status},{steps},{micros},,", flush=True)


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
    """A motion: the centre has a constant velocity, and the body rotates about it at a constant rate."""

    def __init__(self, row, letter):
        part = lambda names: np.array([float(row[f"{letter}_{name}"]) for name in names.split()])
        self.centre = part("cx cy cz")
        self.rotation = unit(part("qw qx qy qz"))
        self.start = part("px py pz") + matrix(self.rotation) @ self.centre
        self.velocity = part("vx vy vz")
        self.spin = part("wx wy wz")

    def at(self, when):
        """Returns the rotation and the position of the centre."""
        return product(exponential(self.spin * when), self.rotation), self.start + when * self.velocity


class Query:
    """The motions of a row, and a bound on the displacement of any point towards the other body."""

    def __init__(self, row, reach):
        self.duration = float(row["duration"])
        self.a, self.b = (Motion(row, letter) for letter in "ab")
        turning = sum(
            np.linalg.norm(motion.spin) * radius(motion.centre)
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
        rotation, centre = motion.at(when)
        turn = matrix(rotation)
        return self.coal.Transform3s(turn, centre - turn @ motion.centre)

    def distance(self, row, _tolerance):
        query = Query(row, self.reach)
        a, b = self.pose(query.a, 0), self.pose(query.b, 0)
        request, result = self.coal.DistanceRequest(), self.coal.DistanceResult()
        begin = time.perf_counter()
        self.coal.distance(self.a, a, self.b, b, request, result)
        return (time.perf_counter() - begin) * 1e6, 1, "static", ""

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
                return spent * 1e6, k + 1, "contact", when
        return spent * 1e6, count + 1, "free", ""


class Fcl:
    def __init__(self, a, b):
        import fcl

        self.fcl = fcl
        self.meshes = [a, b]
        self.reach = [reach_of(vertices) for vertices, _ in (a, b)]
        self.models = {}

    def model(self, k, centre):
        """Returns the mesh with the centre as its origin, made once for each centre."""
        key = (k, *centre)
        if key not in self.models:
            vertices, faces = self.meshes[k]
            model = self.fcl.BVHModel()
            model.beginModel(len(vertices), len(faces))
            model.addSubModel(vertices - centre, faces)
            model.endModel()
            self.models[key] = model
        return self.models[key]

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
            first, last = ([self.fcl.Transform(*m.at(when)) for m in motions] for when in ends)
            a, b = (
                self.fcl.CollisionObject(self.model(j, motions[j].centre), first[j]) for j in (0, 1)
            )
            result = self.fcl.ContinuousCollisionResult()
            begin = time.perf_counter()
            self.fcl.continuousCollide(a, last[0], b, last[1], request, result)
            spent += time.perf_counter() - begin
            if result.is_collide:
                when = ends[0] + result.time_of_contact * (ends[1] - ends[0])
                steps = k + 1 if advances else round((k + result.time_of_contact) * tests) + 1
                return spent * 1e6, steps, "contact", when
        return spent * 1e6, stretches if advances else stretches * tests + 1, "free", ""


def read_obj(path):
    vertices, faces = [], []
    for line in path.open():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [k - 1 if k > 0 else len(vertices) + k for k in corners]
            faces += [[corners[0], p, q] for p, q in zip(corners[1:], corners[2:])]
    return np.array(vertices), np.array(faces)


def reach_of(vertices):
    """Returns a bound of the distance of the body's points from a centre."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return lambda centre: np.linalg.norm(np.maximum(abs(low - centre), abs(high - centre)))


def unit(q):
    return q / np.linalg.norm(q)


def product(p, q):
    return np.concatenate(
        [[p[0] * q[0] - p[1:] @ q[1:]], p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])]
    )


def exponential(turn):
    angle = np.linalg.norm(turn)
    axis = turn / angle if angle > 0 else turn
    return np.concatenate([[math.cos(angle / 2)], math.sin(angle / 2) * axis])


def matrix(q):
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


if __name__ == "__main__":
    main()
