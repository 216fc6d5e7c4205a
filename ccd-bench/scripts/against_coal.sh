#!/usr/bin/env bash
# Compares the times of full queries, each row once and cold, with those of one static distance query of
# Coal on the same rows, in one run on one core.
#
# usage: against_coal.sh SCENES PEER [OUT] [extra options of `ccd query` ...]
#   SCENES   folder with meshes (*.obj) and motions (*.csv)
#   PEER     a program that is called as `PEER a.obj b.obj motions.csv` and prints a column distance_us
#   OUT      folder for the results, a new one by default
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=pairs.sh
. "$here/pairs.sh"
echo "pair,median_us,mean_us,coal_median_us,coal_mean_us,median_ratio,mean_ratio"
while read -r name a b motions; do
    files=("$scenes/$a.obj" "$scenes/$b.obj" "$scenes/$motions.csv")
    taskset -c "$core" "$ccd" query --quiet --threads 1 --a "${files[0]}" --b "${files[1]}" \
        --motions "${files[2]}" --tolerance 1e-3 --repeat 1 --out "$out/$name.csv" "$@"
    taskset -c "$core" python3 "$program" "${files[@]}" >"$out/$name-coal.csv"
    python3 - "$name" "$out/$name.csv" "$out/$name-coal.csv" <<'PY'
import csv, statistics, sys
name, ours, coal = sys.argv[1:]
read = lambda path, column: [float(row[column]) for row in csv.DictReader(open(path))]
a, b = read(ours, "micros"), read(coal, "distance_us")
m, n = statistics.median, statistics.mean
print(f"{name},{m(a):.1f},{n(a):.1f},{m(b):.1f},{n(b):.1f},{m(a)/m(b):.3f},{n(a)/n(b):.3f}", flush=True)
PY
done <<<"$pairs"
