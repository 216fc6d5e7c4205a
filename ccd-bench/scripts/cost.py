#!/usr/bin/env python3
"""Measures the cost of a visit of a pair of nodes, and the least number of visits of a query.

    cost.py SCENES [--ccd PATH] [--rounds N] [--core K]

SCENES is a folder with the meshes (*.obj) and motions (*.csv) that `pairs.sh` names. For each pair it prints
the visits of all rows, the microseconds of a row that is answered once (cold) and five times (warm), with the
best vector instructions and with the baseline, and nanoseconds a visit: sums over all rows, the least of N
rounds.

It needs Linux, for `taskset`."""
import argparse, csv, io, math, statistics, subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", type=Path)
    parser.add_argument("--ccd", default=HERE / "../../target/release/ccd")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--core", default="1")
    options = parser.parse_args()
    settings = [(level, repeat) for level in ("best", "baseline") for repeat in ("1", "5")]
    head = [f"{level}_{'cold' if repeat == '1' else 'warm'}" for level, repeat in settings]
    print("pair,rows,visits_median,visits_mean,oracle_calls_mean,"
          + ",".join(f"{h}_median_us,{h}_mean_us,{h}_ns_a_visit" for h in head))
    for name, a, b, motions in pairs():
        query = Query(options, [options.scenes / f"{mesh}.obj" for mesh in (a, b)])
        file = options.scenes / f"{motions}.csv"
        times = {}
        for _ in range(options.rounds):
            for setting in settings:
                rows = query.run(file, *setting)
                micros = [float(row["micros"]) for row in rows]
                times[setting] = min(times.get(setting, ([math.inf],)), (micros,), key=lambda m: sum(m[0]))
        visits = [int(row["iterations"]) for row in rows]
        calls = [int(row["oracle_calls"]) for row in rows]
        cells = [len(rows), statistics.median(visits), statistics.mean(visits), statistics.mean(calls)]
        for setting in settings:
            (micros,) = times[setting]
            cells += [statistics.median(micros), statistics.mean(micros), 1e3 * sum(micros) / sum(visits)]
        print(",".join([name] + [f"{cell:.1f}" for cell in cells]), flush=True)


class Query:
    def __init__(self, options, meshes):
        a, b = meshes
        self.command = ["taskset", "-c", options.core, options.ccd, "query", "--quiet", "--threads", "1"]
        self.command += ["--tolerance", "1e-3", "--a", a, "--b", b]

    def run(self, motions, level, repeat):
        command = self.command + ["--motions", motions, "--instructions", level, "--repeat", repeat]
        done = subprocess.run(command, check=True, capture_output=True, text=True)
        return list(csv.DictReader(io.StringIO(done.stdout)))


def pairs():
    lines = (HERE / "pairs.sh").read_text().split('pairs="')[1].split('"')[0]
    return [line.split() for line in lines.splitlines()]


if __name__ == "__main__":
    main()
