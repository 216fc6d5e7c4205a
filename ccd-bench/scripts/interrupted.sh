#!/usr/bin/env bash
# Kills `ccd query` twice in the middle of a long table, resumes it, and compares the result with that of an
# undisturbed run: both must have the same bytes. Prints the peak memory of each run.
#
# usage: interrupted.sh [CCD] [ROWS] [OUT]
#   CCD    the command, default target/release/ccd
#   ROWS   the number of rows, default 10000000
#   OUT    folder for the tables (1 GB for 10 million rows, and as much for each result), a new one by default
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
ccd=$(realpath "${1:-$here/../../target/release/ccd}")
rows=${2:-10000000}
out=${3:-$(mktemp -d)}
mkdir -p "$out"
cd "$out"
# Boxes fly at a ball from various sides, some miss it; one row in 99,991 is not a number.
[ -s motions.csv ] || awk -v rows="$rows" 'BEGIN {
    print "id,a_px,a_py,a_vx,a_wz"
    for (k = 0; k < rows; k++)
        printf "r%d,%s,%.3f,%.2f,%.1f\n", k, k % 99991 == 99990 ? "x" : "-3", k % 1009 / 500 - 1, k % 97 / 20, k % 31
}' >motions.csv

query() {
    python3 - "$@" <<'PY'
import resource, subprocess, sys, time
out, seconds, *command = sys.argv[1:]
start = time.monotonic()
process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
try:
    code = process.wait(float(seconds) or None)
except subprocess.TimeoutExpired:
    process.kill()
    process.wait()
    code = "killed"
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
print(f"{out}: {code} after {time.monotonic() - start:.1f} s, peak memory {peak:.1f} MB", flush=True)
open(f"{out}.seconds", "w").write(str(time.monotonic() - start))
PY
}
options=(query --a box:0.5,0.5,0.5 --b sphere:0.3 --motions motions.csv --no-micros --quiet)
query whole 0 "$ccd" "${options[@]}" --out whole.csv
third=$(python3 -c "print(float(open('whole.seconds').read()) / 3)")
query parts "$third" "$ccd" "${options[@]}" --out parts.csv --resume
query parts "$third" "$ccd" "${options[@]}" --out parts.csv --resume
query parts 0 "$ccd" "${options[@]}" --out parts.csv --resume
echo "$(($(wc -l <whole.csv) - 1)) rows, $(grep -c ,error, whole.csv) of status error"
cmp whole.csv parts.csv && echo "the same bytes"
