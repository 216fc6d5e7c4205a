"""Samples the paths that `plan` has written by pinocchio and Coal, which share no code with it: `pip install pin`.

    python judge.py FOLDER_OF_arm.urdf PATHS [SAMPLES OF AN EDGE]

It counts the paths on which a sample touches, and prints the least distance of all samples.
"""

import csv
import itertools
import sys

import coal
import numpy as np
import pinocchio


def arm_among_boxes(folder):
    model = pinocchio.buildModelFromUrdf(f"{folder}/arm.urdf")
    geometry = pinocchio.buildGeomFromUrdf(model, f"{folder}/arm.urdf", pinocchio.GeometryType.COLLISION, [folder])
    geometry.addAllCollisionPairs()
    pinocchio.removeCollisionPairs(model, geometry, f"{folder}/arm.srdf")
    links = range(geometry.ngeoms)
    for k in range(5):
        place = np.array([0.8 * np.cos(1.2566 * k), 0.8 * np.sin(1.2566 * k), 0.3 * k - 0.5])
        box = coal.Box(0.2, 0.2, 0.6)
        number = geometry.addGeometryObject(
            pinocchio.GeometryObject(f"box {k}", 0, pinocchio.SE3(np.eye(3), place), box)
        )
        for link in links:
            if geometry.geometryObjects[link].parentJoint:
                geometry.addCollisionPair(pinocchio.CollisionPair(link, number))
    return model, geometry


def read_paths(file):
    with open(file) as lines:
        rows = [(row[0], np.array(row[1:], float)) for row in csv.reader(lines)]
    return [[state for _, state in path] for _, path in itertools.groupby(rows, lambda row: row[0])]


def main(folder, file, samples="1000"):
    model, geometry = arm_among_boxes(folder)
    data, geometry_data = model.createData(), geometry.createData()

    def distance(state):
        pinocchio.updateGeometryPlacements(model, data, geometry, geometry_data, state)
        pinocchio.computeDistances(geometry, geometry_data)
        return min(result.min_distance for result in geometry_data.distanceResults)

    paths = read_paths(file)
    fractions = np.linspace(0.0, 1.0, int(samples))
    least, edges, touching = np.inf, 0, 0
    for path in paths:
        on_path = np.inf
        for start, end in zip(path, path[1:]):
            edges += 1
            on_path = min(on_path, *(distance(start + fraction * (end - start)) for fraction in fractions))
        least = min(least, on_path)
        touching += on_path <= 0.0
    print(
        f"{len(paths)} paths of {edges} edges, {len(geometry.collisionPairs)} pairs, {samples} samples of an edge: "
        f"{touching} paths touch; the least distance is {least:.3g}"
    )
    return touching > 0 or not paths


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
