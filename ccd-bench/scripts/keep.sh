#!/usr/bin/env bash
# Stores the measurements of an evaluation: chart.csv as dated rows with machine and commit in results/. Draws the
# chart of the root README anew, from the tables of README.md, which are those of REPORT/tables.md.
#
# usage: keep.sh [REPORT [COMMIT]]
#   REPORT   the folder that `ccd-bench chart --out` wrote to, default target/ccd-report
#   COMMIT   the commit of the program that measured, default the one checked out
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
report=${1:-$here/../target/ccd-report}
machine=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)
name=$(printf '%s' "$machine" | sed 's/([A-Za-z]*)//g' | tr -cs '[:alnum:]' '-' | tr '[:upper:]' '[:lower:]' | sed 's/^-//; s/-$//')
day=$(date +%F)
commit=${2:-}
if [ -z "$commit" ]; then
    commit=$(git -C "$here" rev-parse --short HEAD)
    git -C "$here" diff --quiet HEAD || commit="$commit+changes"
fi
out=$here/results/$day-$name-chart.csv
awk -v head="date,machine,commit" -v row="$day,$machine,$commit" \
    '{ print (NR == 1 ? head : row) "," $0 }' "$report/chart.csv" >"$out"
"$here/scripts/speed.py"
echo "$out"
