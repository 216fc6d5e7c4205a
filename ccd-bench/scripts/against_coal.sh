#!/usr/bin/env bash
# Compares the times of full queries, each row once and cold, with those of one static distance query of
# Coal on the same rows, on one core. Several rounds take turns; of each row the least time counts, on both
# sides: other work on the machine only ever adds to a time.
#
# usage: against_coal.sh SCENES PEER [OUT] [extra options of `ccd query` ...]
#   SCENES   folder with meshes (*.obj) and motions (*.csv)
#   PEER     a program that is called as `PEER a.obj b.obj motions.csv` and prints a column distance_us
#   OUT      folder for the results, a new one by default
#   ROUNDS   (environment) the number of rounds, 5 by default
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=pairs.sh
. "$here/pairs.sh"
rounds=${ROUNDS:-5}
echo "pair,median_us,mean_us,coal_median_us,coal_mean_us,median_ratio,mean_ratio"
while read -r name a b motions; do
    files=("$scenes/$a.obj" "$scenes/$b.obj" "$scenes/$motions.csv")
    for round in $(seq "$rounds"); do
        taskset -c "$core" "$ccd" query --quiet --threads 1 --a "${files[0]}" --b "${files[1]}" \
            --motions "${files[2]}" --tolerance 1e-3 --repeat 1 --out "$out/$name-$round.csv" "$@"
        taskset -c "$core" python3 "$program" "${files[@]}" >"$out/$name-coal-$round.csv"
    done
    python3 - "$name" "$out" "$rounds" <<'PY'
import csv, statistics, sys
name, out, rounds = sys.argv[1], sys.argv[2], int(sys.argv[3])
def least(kind, column):
    files = [f"{out}/{name}{kind}-{round + 1}.csv" for round in range(rounds)]
    runs = [[float(row[column]) for row in csv.DictReader(open(file))] for file in files]
    return [min(times) for times in zip(*runs, strict=True)]
a, b = least("", "micros"), least("-coal", "distance_us")
m, n = statistics.median, statistics.mean
print(f"{name},{m(a):.1f},{n(a):.1f},{m(b):.1f},{n(b):.1f},{m(a)/m(b):.3f},{n(a)/n(b):.3f}", flush=True)
PY
done <<<"$pairs"
