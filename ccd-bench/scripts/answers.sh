#!/usr/bin/env bash
# Compares the answers of `ccd query` with certified brackets of the first contact, for every pair of
# meshes, oracle and tolerance.
#
# usage: answers.sh SCENES VERDICT [OUT] [extra options of `ccd query` ...]
#   SCENES   folder with meshes (*.obj), motions (*.csv) and brackets (truth_*.csv)
#   VERDICT  a program that is called as `VERDICT truth.csv result.csv` and prints the counts
#   OUT      folder for the results, a new one by default
# environment: ORACLES="gjk vmarch" and TOLERANCES="1e-3" select oracles and tolerances, CCD=… is the command
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=pairs.sh
. "$here/pairs.sh"
for tolerance in ${TOLERANCES:-1e-3 1e-6}; do
    for oracle in ${ORACLES:-direct gjk}; do
        while read -r name a b motions; do
            result=$out/$name-$oracle-$tolerance.csv
            "$ccd" query --quiet --a "$scenes/$a.obj" --b "$scenes/$b.obj" \
                --motions "$scenes/$motions.csv" --oracle "$oracle" --tolerance "$tolerance" \
                --out "$result" "$@"
            echo "$name $oracle $tolerance $(python3 "$program" "$scenes/truth_$name.csv" "$result")"
        done <<<"$pairs"
    done
done
