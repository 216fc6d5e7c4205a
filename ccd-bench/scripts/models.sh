#!/usr/bin/env bash
# Prints the cost and the error of each model of the meshes as a table in Markdown. For every pair of meshes
# and every model it has the number of pieces, the time to prepare them, the memory, the median time of a
# query, and the distance of the times of contact from certified brackets.
#
# usage: models.sh SCENES VERDICT [OUT] [extra options of `ccd query` ...]
#   SCENES   folder with meshes (*.obj), motions (*.csv) and brackets (truth_*.csv)
#   VERDICT  a program that is called as `VERDICT truth.csv result.csv` and prints the counts
#   OUT      folder for the results, a new one by default
# environment: PAIRS="ring santa" selects pairs, CORE=1 is the core to run on, CCD=… the command
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=pairs.sh
. "$here/pairs.sh"

# The name, the options of `ccd decompose`, the options of `ccd query`.
models="triangles|--pieces triangles|
patches|--pieces patches|"

echo "| scene | model | pieces | build, ms | memory, MB | query, median µs | error of the time, median | largest | rows: late, missed, false, unresolved |"
echo "|---|---|---|---|---|---|---|---|---|"
while read -r name a b motions; do
    [[ " ${PAIRS:-$name} " == *" $name "* ]] || continue
    bodies=("$a")
    [ "$a" = "$b" ] || bodies+=("$b")
    while IFS='|' read -r model make use; do
        result=$out/$name-${model// /-}
        : >"$result.json"
        for body in "${bodies[@]}"; do
            # Options are split at spaces.
            # shellcheck disable=SC2086
            taskset -c "$core" "$ccd" decompose "$scenes/$body.obj" $make --quiet --format json \
                --out "$out/$body-${model// /-}.ccd" >>"$result.json"
        done
        # shellcheck disable=SC2086
        taskset -c "$core" "$ccd" query --quiet --threads 1 --a "$out/$a-${model// /-}.ccd" \
            --b "$out/$b-${model// /-}.ccd" --motions "$scenes/$motions.csv" $use \
            --tolerance 1e-3 --out "$result.csv" "$@"
        python3 "$program" "$scenes/truth_$name.csv" "$result.csv" >"$result.verdict"
        python3 - "$name" "$model" "$result" "$scenes/truth_$name.csv" <<'PY'
import csv, json, re, statistics, sys
name, model, result, truth = sys.argv[1:]
rows = lambda path: {row["id"]: row for row in csv.DictReader(open(path))}
bodies = [json.loads(line) for line in open(result + ".json") if line.strip()]
answers, truth = rows(result + ".csv"), rows(truth)

def error(row, bracket):
    """Returns the distance of a time of contact from the bracket."""
    time, lo, hi = float(row["time"]), float(bracket["lo"]), float(bracket["hi"])
    return max(lo - time, time - hi, 0.0)

hits = ("contact", "touching", "overlapping")
errors = [error(row, truth[id]) for id, row in answers.items()
          if row["status"] in hits and id in truth and truth[id]["status"] == "hit"]
counts = dict(re.findall(r"'?(late|missed|false|unresolved)'?\s*[:=]\s*(\d+)", open(result + ".verdict").read()))
micros = statistics.median(float(row["micros"]) for row in answers.values())
total = lambda key: sum(body[key] for body in bodies)
print(f"| {name} | {model} | {total('pieces'):,} | {total('build_ms'):,.0f} | {total('bytes') / 1e6:.1f} | {micros:.0f} "
      f"| {statistics.median(errors):.1e} | {max(errors):.1e} | {len(answers)}: "
      + ", ".join(counts.get(key, "?") for key in ("late", "missed", "false", "unresolved")) + " |", flush=True)
PY
    done <<<"$models"
done <<<"$pairs"
