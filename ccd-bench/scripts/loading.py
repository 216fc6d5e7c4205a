#!/usr/bin/env python3
"""Measures time and memory of `ccd decompose` on meshes of slivers and of large planar parts.

usage: loading.py CCD [--triangles N,N,…] [--limit SECONDS] [--only WORD] [MESH…]

Makes prisms, combs, tents, cones and stars of about the given numbers of triangles in a temporary folder,
and prepares each of them, or the given meshes, in every way. Prints a row for each: the seconds of
preparation (from `build_ms`); the seconds of processor time and the peak of the resident memory in MB,
including reading, as measured by the system; and the outcome.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time

WAYS = {
    "auto": ["--pieces", "auto"],
    "patches": ["--pieces", "patches"],
    "hull": ["--pieces", "hull"],
    "vhacd": ["--pieces", "vhacd"],
    "hull tree": ["--pieces", "triangles", "--hull-tree"],
}


def ring(n, radius=lambda k: 1.0, z=0.0):
    angles = (2.0 * math.pi * k / n for k in range(n))
    return [(radius(k) * math.cos(a), radius(k) * math.sin(a), z) for k, a in enumerate(angles)]


def prism(outline, height):
    """Extrudes a polygon along z; the caps are two polygons, which are read as fans."""
    n = len(outline)
    vertices = [(x, y, 0.0) for x, y, *_ in outline] + [(x, y, height) for x, y, *_ in outline]
    sides = [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
    return vertices, [[0, *reversed(range(1, n))], list(range(n, 2 * n))] + sides


def cylinder(triangles):
    return prism(ring(triangles // 4), 1.0)


def comb(triangles):
    """Makes teeth on a bar; the fans of its caps overlap, so that it bounds no solid."""
    outline = [(0.0, 0.0)]
    for tooth in range(triangles // 16, 0, -1):
        x = 2.0 * tooth
        outline += [(x, 1.0), (x, 5.0), (x - 1.0, 5.0), (x - 1.0, 1.0)]
    outline[1:1] = [(triangles / 8 + 1.0, 0.0)]
    return prism(outline, 1.0)


def slanted(triangles):
    """Makes teeth that lean away from the first corner, which sees all of them: a solid."""
    n = max(triangles // 8, 2)
    outline = [(0.0, 0.0)]
    for k in range(2 * n):
        angle, radius = 0.5 * math.pi * k / (2 * n - 1), 1.0 if k % 2 else 0.9
        outline.append((radius * math.cos(angle), radius * math.sin(angle)))
    return prism(outline, 0.2)


def notched(triangles):
    """Makes a cylinder with a step: large caps that no point sees completely."""
    n = triangles // 8
    low, high, top = ring(n), ring(n, z=1.0), ring(n, lambda _: 0.3, 1.0)
    end = ring(n, lambda _: 0.3, 21.0)
    faces = [list(reversed(range(n))), list(range(3 * n, 4 * n))]
    for k in range(n):
        l = (k + 1) % n
        for base in (0, n, 2 * n):
            faces.append([base + k, base + l, base + n + l, base + n + k])
    return low + high + top + end, faces


def tent(triangles):
    """Makes a convex roof over a grid, with one polygon as floor."""
    n = max(int(math.sqrt(triangles / 2)), 2)
    grid = lambda i, j: i * (n + 1) + j
    arch = lambda t: t * (1.0 - t)
    vertices = [
        (i / n, j / n, arch(i / n) + arch(j / n)) for i in range(n + 1) for j in range(n + 1)
    ]
    faces = []
    for i in range(n):
        for j in range(n):
            a, b, c, d = grid(i, j), grid(i + 1, j), grid(i + 1, j + 1), grid(i, j + 1)
            faces += [[a, b, d], [b, c, d]]
    rim = [grid(0, j) for j in range(n)] + [grid(i, n) for i in range(n)]
    rim += [grid(n, j) for j in range(n, 0, -1)] + [grid(i, 0) for i in range(n, 0, -1)]
    low = len(vertices)
    vertices += [(vertices[v][0], vertices[v][1], -0.1) for v in rim]
    for k, v in enumerate(rim):
        l = (k + 1) % len(rim)
        faces.append([v, rim[l], low + l, low + k])
    return vertices, faces + [list(range(low, low + len(rim)))]


def cones(triangles, inner):
    n = triangles // 4 * 2
    vertices = ring(n, lambda k: inner if k % 2 else 1.0) + [(0, 0, 1), (0, 0, -1)]
    faces = []
    for k in range(n):
        l = (k + 1) % n
        faces += [[k, l, n], [l, k, n + 1]]
    return vertices, faces


SHAPES = {
    "cylinder": cylinder,
    "comb": comb,
    "slanted comb": slanted,
    "notched": notched,
    "tent": tent,
    "bipyramid": lambda n: cones(n, 1.0),
    "star": lambda n: cones(n, 0.5),
}


def write(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v %r %r %r\n" % tuple(map(float, v)) for v in vertices)
        file.writelines("f " + " ".join(str(v + 1) for v in face) + "\n" for face in faces)


def run(command, limit):
    """Returns processor time in seconds, peak memory in MB, exit code (None if stopped), and both outputs."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        start = time.monotonic()
        child = subprocess.Popen(command, stdout=out, stderr=err)
        while True:
            pid, status, usage = os.wait4(child.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - start > limit:
                child.kill()
                _, _, usage = os.wait4(child.pid, 0)
                return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, None, "", ""
            time.sleep(0.005)
        out.seek(0)
        err.seek(0)
        texts = [stream.read().decode(errors="replace") for stream in (out, err)]
        seconds, code = usage.ru_utime + usage.ru_stime, os.waitstatus_to_exitcode(status)
        return seconds, usage.ru_maxrss / 1024, code, *texts


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ccd")
    parser.add_argument("meshes", nargs="*")
    parser.add_argument("--triangles", default="1000,10000,100000")
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("--only", default="")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        meshes = [(os.path.basename(path), path) for path in args.meshes]
        for name, make in SHAPES.items() if not meshes else ():
            for count in map(int, args.triangles.split(",")):
                path = os.path.join(folder, "%s_%d.obj" % (name.replace(" ", "_"), count))
                write(path, *make(count))
                meshes.append((name, path))
        print(f"{'mesh':24} {'way':10} {'triangles':>9} {'build s':>8} {'cpu s':>8} {'MB':>7}  outcome")
        for name, path in meshes:
            for way, options in WAYS.items():
                if args.only not in f"{name} {way}":
                    continue
                command = [args.ccd, "decompose", "-q", "--format", "json", *options, path]
                cpu, peak, code, out, err = run(command, args.limit)
                report = json.loads(out) if code == 0 else {}
                outcome = f"{report['pieces']} {report['pieces_kind']}: {report['why']}" if report else err
                outcome = "stopped" if code is None else outcome.strip().splitlines()[0][-90:]
                build = report.get("build_ms", math.nan) / 1000
                count = report.get("triangles", 0)
                print(f"{name:24} {way:10} {count:9} {build:8.3f} {cpu:8.3f} {peak:7.0f}  {outcome}")
                sys.stdout.flush()


if __name__ == "__main__":
    main()
