#!/bin/sh
# Opens a page in a headless browser and takes a screenshot. The console must stay empty, and the page has
# to draw all its parts: the view in three dimensions, or those that are named. A page with modules of its own
# has an address, because browsers load none from files.
#
#   check_page.sh PAGE.html|ADDRESS SHOT.png [WIDTH,HEIGHT [PART...]]
#
# Exit code 0: success; 1: the page is wrong; 2: wrong arguments; 3: no browser found.
set -eu

address=
if [ $# -ge 2 ]; then
    case $1 in
    http://* | https://*) address=$1 ;;
    *) [ ! -f "$1" ] || address=file://$(realpath "$1") ;;
    esac
fi
if [ -z "$address" ]; then
    echo "usage: $0 PAGE.html|ADDRESS SHOT.png [WIDTH,HEIGHT [PART...]]" >&2
    exit 2
fi
shot=$(realpath -m "$2")
size=${3:-1200,1800}
if [ $# -gt 3 ]; then
    shift 3
else
    set -- view
fi

browser=
for name in chromium chromium-browser google-chrome; do
    if command -v "$name" >/dev/null 2>&1; then
        browser=$name
        break
    fi
done
if [ -z "$browser" ]; then
    echo "$0: no browser; install chromium (Debian: apt install chromium) or Google Chrome" >&2
    exit 3
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Each call has a new profile. WebGL runs in software, since a headless machine has no other. The budget is
# in the page's virtual time: enough for the scripts to finish.
browse() {
    timeout 180 "$browser" --headless --no-sandbox --disable-quic --no-first-run \
        --disable-background-networking --disable-component-update --disable-sync \
        --use-angle=swiftshader --enable-unsafe-swiftshader \
        --user-data-dir="$(mktemp -d -p "$work")" --enable-logging=stderr --v=0 \
        --virtual-time-budget=30000 --window-size="$size" "$@" "$address"
}

browse --dump-dom >"$work/dom" 2>"$work/log" || {
    cat "$work/log" >&2
    echo "$0: the browser failed" >&2
    exit 1
}
fault=0
if grep 'CONSOLE' "$work/log" >&2; then
    echo "$0: the page writes to the console" >&2
    fault=1
fi
root=$(grep -o -m1 '<html[^>]*>' "$work/dom" | head -n 1)
for part in "$@"; do
    marker="data-$part=\"drawn\""
    case $root in
    *"$marker"*) ;;
    *)
        echo "$0: the page has not set $marker: $root" >&2
        fault=1
        ;;
    esac
done
browse --screenshot="$shot" >/dev/null 2>"$work/log" || true
if [ ! -s "$shot" ]; then
    cat "$work/log" >&2
    echo "$0: no screenshot was taken" >&2
    fault=1
fi
exit $fault
