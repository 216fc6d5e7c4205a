#!/usr/bin/env python3
"""Stores the results of `cargo bench -p ccd-bench` as dated rows with machine and commit in results/.

usage: keep_bench.py [CRITERION_FOLDER]      default target/criterion

The columns are date,machine,commit,benchmark,elements,median_ns. The time is that of the whole sequence of
`elements` calls or queries, if there are any.
"""
import csv
import datetime
import json
import re
import subprocess
import sys
from pathlib import Path

here = Path(__file__).resolve().parent.parent
folder = Path(sys.argv[1]) if len(sys.argv) > 1 else here.parent / "target" / "criterion"


def git(*words):
    return subprocess.run(["git", "-C", here, *words], capture_output=True, text=True, check=True).stdout.strip()


cpu = re.search(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo").read_text())
machine = cpu.group(1) if cpu else "unknown"
name = re.sub(r"[^a-z0-9]+", "-", re.sub(r"\([A-Za-z]*\)", "", machine).lower()).strip("-")
day = datetime.date.today().isoformat()
commit = git("rev-parse", "--short", "HEAD") + ("+changes" if git("status", "--porcelain") else "")
rows = []
for described in sorted(folder.glob("**/new/benchmark.json")):
    benchmark = json.loads(described.read_text())
    estimates = json.loads((described.parent / "estimates.json").read_text())
    elements = (benchmark.get("throughput") or {}).get("Elements", "")
    median = estimates["median"]["point_estimate"]
    rows.append([day, machine, commit, benchmark["full_id"], elements, f"{median:.1f}"])
if not rows:
    sys.exit(f"{folder} holds no results; run `cargo bench -p ccd-bench` first")
out = here / "results" / f"{day}-{name}-bench.csv"
with out.open("w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["date", "machine", "commit", "benchmark", "elements", "median_ns"])
    writer.writerows(rows)
print(out)
