#!/usr/bin/env bash
# Compares the times of the paper's own method (one step for all pairs over hull trees of patches, Voronoi
# marching) with those of the default schedule and of one static distance query of Coal, in one run on one
# core. Prints the mean number of advancement steps, too.
#
# usage: as_published.sh SCENES PEER [OUT]
#   SCENES   folder with meshes (*.obj) and motions (*.csv)
#   PEER     a program that is called as `PEER a.obj b.obj motions.csv` and prints a column distance_us
#   OUT      folder for the results, a new one by default
# environment: CCD=… is the command, CORE=… the core, REPEAT=… the number of answers to each row, 3 by
# default; the time is their median, which excludes preparation on first use
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=pairs.sh
. "$here/pairs.sh"
methods="best-first --schedule best-first
fast-vmarch --schedule fast --oracle vmarch --pieces patches
fast-gjk --schedule fast --oracle gjk --pieces patches"
echo "pair,method,median_us,mean_us,of_best_first,of_best_first_mean,of_coal,of_coal_mean,advancements,oracle_calls,oracle_steps"
while read -r name a b motions; do
    files=("$scenes/$a.obj" "$scenes/$b.obj" "$scenes/$motions.csv")
    taskset -c "$core" python3 "$program" "${files[@]}" >"$out/$name-coal.csv"
    while read -r method options; do
        # Options are split at spaces.
        # shellcheck disable=SC2086
        taskset -c "$core" "$ccd" query --quiet --threads 1 --a "${files[0]}" --b "${files[1]}" \
            --motions "${files[2]}" --tolerance 1e-3 --repeat "${REPEAT:-3}" --counters \
            --out "$out/$name-$method.csv" $options
        python3 - "$name" "$method" "$out" <<'PY'
import csv, statistics, sys
name, method, out = sys.argv[1:]
def read(what, column):
    return [float(row[column]) for row in csv.DictReader(open(f"{out}/{name}-{what}.csv"))]
def times(what, column="micros"):
    values = read(what, column)
    return statistics.median(values), statistics.mean(values)
(m, n), (bm, bn), (cm, cn) = times(method), times("best-first"), times("coal", "distance_us")
counts = [statistics.mean(read(method, c)) for c in ("advancements", "oracle_calls", "oracle_steps")]
print(f"{name},{method},{m:.1f},{n:.1f},{m/bm:.2f},{n/bn:.2f},{m/cm:.3f},{n/cn:.3f},"
      + ",".join(f"{c:.2f}" for c in counts), flush=True)
PY
    done <<<"$methods"
done <<<"$pairs"
