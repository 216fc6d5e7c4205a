#!/bin/sh
# Opens a page in a headless browser: nothing may be said on the console, and the page has to have
# drawn its plane and its view in three dimensions. Takes a picture of it.
#
#   check_page.sh PAGE.html SHOT.png [WIDTH,HEIGHT]
#
# Exit code 0: all well; 1: the page is at fault; 2: wrong arguments; 3: no browser here.
set -eu

if [ $# -lt 2 ] || [ $# -gt 3 ] || [ ! -f "$1" ]; then
    echo "usage: $0 PAGE.html SHOT.png [WIDTH,HEIGHT]" >&2
    exit 2
fi
page=$(realpath "$1")
shot=$(realpath -m "$2")
size=${3:-1200,1800}

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

# A profile of its own each time; WebGL by software, since a headless machine has nothing else. The
# budget is of the page's own clock: enough for scripts to come to rest.
browse() {
    timeout 180 "$browser" --headless --no-sandbox --disable-quic --no-first-run \
        --disable-background-networking --disable-component-update --disable-sync \
        --use-angle=swiftshader --enable-unsafe-swiftshader \
        --user-data-dir="$(mktemp -d -p "$work")" --enable-logging=stderr --v=0 \
        --virtual-time-budget=30000 --window-size="$size" "$@" "file://$page"
}

browse --dump-dom >"$work/dom" 2>"$work/log" || {
    cat "$work/log" >&2
    echo "$0: the browser failed" >&2
    exit 1
}
fault=0
if grep 'CONSOLE' "$work/log" >&2; then
    echo "$0: the page says something on the console" >&2
    fault=1
fi
root=$(grep -o -m1 '<html[^>]*>' "$work/dom" | head -n 1)
for marker in 'data-plane="drawn"' 'data-view="drawn"'; do
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
    echo "$0: no picture was taken" >&2
    fault=1
fi
exit $fault
