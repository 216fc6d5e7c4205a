#!/usr/bin/env python3
"""Measures the cost of a visit of a pair of nodes, and the least number of visits of a query.

    cost.py SCENES [--ccd PATH] [--rounds N] [--core K]

SCENES is a folder with the meshes (*.obj) and motions (*.csv) that `pairs.sh` names. For each pair it prints
the visits of all rows, the microseconds of a row that is answered once (cold) and five times (warm), with the
best vector instructions and with the baseline, and nanoseconds a visit: sums over all rows, the least of N
rounds.

The last columns compare the rows in contact with a run that knows their times: their motions end just before.
It has to prove the same, that nothing touches until then, by the same bounds. Their ratio says what a better
order of the visits could save.

It needs Linux, for `taskset`. Rows end at poses (columns a_end_*), and only A moves."""
import argparse, csv, io, math, statistics, subprocess, tempfile
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
          + ",".join(f"{h}_median_us,{h}_mean_us,{h}_ns_a_visit" for h in head)
          + ",contacts,visits_of_contacts,visits_knowing")
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
        ended, before = until_contact(file, rows)
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as known:
            known.write(ended)
            known.flush()
            after = [int(row["iterations"]) for row in query.run(known.name, "best", "1")]
        print(",".join([name] + [f"{cell:.1f}" for cell in cells] + [str(len(before)), str(sum(before)), str(sum(after))]), flush=True)


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


def until_contact(file, results):
    """Returns the motions of the rows with a contact, shortened to end before it, and the visits of these rows."""
    out, visits = io.StringIO(), []
    with open(file) as motions:
        rows = csv.DictReader(motions)
        writer = csv.DictWriter(out, rows.fieldnames)
        writer.writeheader()
        for row, result in zip(rows, results):
            if result["status"] == "contact":
                writer.writerow(ended(row, float(result["time"]) * (1 - 1e-9)))
                visits.append(int(result["iterations"]))
    return out.getvalue(), visits


def ended(row, part):
    """Returns a row whose end pose of A is that after this share of the motion."""
    start, end = ([float(row[f"a_{which}q{k}"]) for k in "wxyz"] for which in ("", "end_"))
    rotation = turned(start, end, part)
    new = {f"a_end_q{k}": repr(value) for k, value in zip("wxyz", rotation)}
    for k in "xyz":
        here, there = float(row[f"a_p{k}"]), float(row[f"a_end_p{k}"])
        new[f"a_end_p{k}"] = repr(here + (there - here) * part)
    return {**row, **new}


def turned(p, q, part):
    """Returns the rotation after this share of the shorter rotation from p to q."""
    turn = product(q, [p[0], -p[1], -p[2], -p[3]])
    turn = [-x for x in turn] if turn[0] < 0 else turn
    sine = math.hypot(*turn[1:])
    if sine == 0:
        return p
    half = math.atan2(sine, turn[0]) * part
    return product([math.cos(half)] + [math.sin(half) / sine * x for x in turn[1:]], p)


def product(a, b):
    (w, x, y, z), (s, i, j, k) = a, b
    return [w * s - x * i - y * j - z * k, w * i + x * s + y * k - z * j,
            w * j - x * k + y * s + z * i, w * k + x * j - y * i + z * s]


if __name__ == "__main__":
    main()
