#!/usr/bin/env python3
"""Checks forged proofs with second_opinion.py, and compares its verdicts with the verdicts of ccd-check in the file.

`cargo run --release -p ccd-bench --example forgeries -- FILE` writes the file.
"""
import argparse, collections, functools, hashlib, os, struct, sys, tempfile
import second_opinion as so

COLUMNS = "forged", "both refuse", "both hold", "only ccd-check holds", "only second_opinion holds", "false ones hold"


def read_records(file):
    """Yields each record: the kind of forgery, the verdict of ccd-check and whether the statement is true, the proof,
    and both meshes with their trees."""
    while head := file.read(4):
        record = []
        for _ in range(7):
            record.append(file.read(struct.unpack("<I", head)[0]))
            head = file.read(4) if len(record) < 7 else b""
        yield record


def verdict(folder, proof, meshes):
    def write(name, data):
        path = os.path.join(folder, name)
        with open(path, "wb") as f:
            f.write(data)
        return path

    @functools.cache
    def tree_of(digest):
        for k, (mesh, tree) in enumerate(meshes):
            if hashlib.sha256(mesh).digest() == digest:
                return so.Tree(write(f"{k}.mesh", mesh), write(f"{k}.body", tree))
        raise so.Fails("broken", "the mesh is missing")

    try:
        # ccd-check reads all meshes, including those that the proof does not use.
        for mesh, _ in meshes:
            tree_of(hashlib.sha256(mesh).digest())
        so.check(write("forged.proof", proof), tree_of)
    except so.Fails as e:
        return e.args[0]
    except RecursionError:
        return "unverifiable"
    return "holds"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("--fraction", default="0/1", help="only records whose index is K modulo N, as K/N; an odd N includes all kinds")
    arguments = parser.parse_args()
    k, n = map(int, arguments.fraction.split("/"))
    counts = collections.defaultdict(lambda: [0] * len(COLUMNS))
    with open(arguments.file, "rb") as file, tempfile.TemporaryDirectory() as folder:
        for number, (kind, verdict_and_truth, proof, a, tree_a, b, tree_b) in enumerate(read_records(file)):
            if number % n != k:
                continue
            ccd_check_holds, is_true = verdict_and_truth[:1] == b"h", verdict_and_truth[1]
            second_opinion_holds = verdict(folder, proof, [(a, tree_a), (b, tree_b)]) == "holds"
            row = counts[kind.decode()]
            row[0] += 1
            if ccd_check_holds == second_opinion_holds:
                row[1 + ccd_check_holds] += 1
            else:
                row[3 + second_opinion_holds] += 1
            row[5] += second_opinion_holds and not is_true
    print("kind", *COLUMNS, sep=";")
    for kind, row in counts.items():
        print(kind, *row, sep=";")
    print("all", *map(sum, zip(*counts.values())), sep=";")
    return int(sum(row[5] for row in counts.values()) > 0)


if __name__ == "__main__":
    sys.exit(main())
