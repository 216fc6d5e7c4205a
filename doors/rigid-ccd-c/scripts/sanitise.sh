#!/usr/bin/env bash
# Runs the interface's tests and C++ programs under sanitisers, and some tests in Miri, which takes half an hour:
#   doors/rigid-ccd-c/scripts/sanitise.sh [STEP...]     of: address thread miri
# Fails if one of them finds something, and says what it has skipped. `CCD_TEST_CASES` is as for the tests. The folder of the
# builds is SANITISE_TARGET_DIR, or target/sanitise. Needs a nightly compiler with rust-src and miri, and a C++ compiler.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
steps=${*:-address thread miri}
folder=$(realpath -m "${SANITISE_TARGET_DIR:-target/sanitise}")
host=$(rustc -vV | sed -n 's/^host: //p')
components=$(rustup component list --toolchain nightly 2>/dev/null | grep -E 'installed|default' || true)
skipped=() found=()

step() { printf '\n== %s (%d:%02d min)\n' "$*" "$((SECONDS / 60))" "$((SECONDS % 60))"; }
skip() { echo "skipped: $*"; skipped+=("$*"); }
# Runs a command, and continues if it fails, because other sanitisers may find more.
check() { "$@" || { echo "FAILED: $*" >&2; found+=("$*"); }; }
has() { grep -q "^$1.*(installed)" <<<"$components"; }

# Stops at the first finding, with a status that differs from that of a failed test.
export ASAN_OPTIONS=detect_leaks=1:detect_stack_use_after_return=1 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1 RUST_TEST_THREADS=2

# cargo_with SANITISER COMMAND... runs cargo with the library, and its standard library, built for a sanitiser.
cargo_with() {
    local sanitiser=$1 command=$2
    shift 2
    RUSTFLAGS="-Zsanitizer=$sanitiser" CARGO_TARGET_DIR="$folder/$sanitiser" \
        cargo +nightly "$command" --locked -Zbuild-std --target "$host" -p rigid-ccd-c "$@"
}

# Writes the functions that code of LLVM calls and the thread sanitiser of gcc lacks. That sanitiser intercepts the
# originals.
write_missing() {
    local size='unsigned long count' name
    for name in memcpy memmove; do
        echo "void *$name(void *, const void *, unsigned long);"
        echo "__attribute__((weak)) void *__tsan_$name(void *to, const void *from, $size) { return $name(to, from, count); }"
    done
    echo "void *memset(void *, int, unsigned long);"
    echo "__attribute__((weak)) void *__tsan_memset(void *to, int value, $size) { return memset(to, value, count); }"
}

# program SANITISERS LIBRARY SOURCE [ARGUMENT...] builds a program of the interface, and runs it.
program() {
    local sanitisers=$1 library=$2 source=$3 compiler=(c++ -std=c++17)
    shift 3
    [[ $source == *.c ]] && compiler=(cc -std=c99)
    echo "$source with -fsanitize=$sanitisers"
    "${compiler[@]}" -g -O1 "-fsanitize=$sanitisers" -fno-sanitize-recover=all -fno-omit-frame-pointer \
        -Idoors/rigid-ccd-c/include "${ompl[@]}" -o "$folder/program" "doors/rigid-ccd-c/$source" "$folder/missing.o" "$library" "${ompl_libraries[@]}" \
        -lpthread -ldl -lm && "$folder/program" "$@"
}

# sanitise SANITISER SANITISERS_OF_C runs the tests of the interface, then programs with both sides sanitised.
sanitise() {
    local sanitiser=$1 of_c=$2 library="$folder/$1/$host/debug/deps/librigid_ccd_c.a" robot=rigid-ccd-robot/examples/edges
    has rust-src || { skip "$sanitiser: rustup component add rust-src --toolchain nightly"; return; }
    step "$sanitiser: tests"
    # Tests of the header build programs, which run below.
    check cargo_with "$sanitiser" test --test it -- --skip header::
    step "$sanitiser: programs in C and C++"
    local ompl=() ompl_libraries=()
    check program "$of_c" "$library" examples/first_contact.c
    check program "$of_c" "$library" examples/first_contact.cpp
    check program "$of_c" "$library" tests/programs/expected.cpp
    check program "$of_c" "$library" tests/programs/cells.cpp "$robot/arm.urdf" link7
    if pkg-config --exists ompl eigen3; then
        read -ra ompl <<<"-DRIGID_CCD_WITH_OMPL $(pkg-config --cflags-only-I ompl eigen3 | sed 's/-I/-isystem /g')"
        read -ra ompl_libraries <<<"$(pkg-config --libs ompl)"
    else
        skip "$sanitiser: rigid_ccd_ompl.hpp, OMPL is not installed"
    fi
    check program "$of_c" "$library" tests/programs/threads.cpp "$robot/arm.urdf"
}

# run_miri FLAGS TEST...
run_miri() {
    local flags=$1
    shift
    has miri || { skip "miri: rustup component add miri rust-src --toolchain nightly"; return; }
    step "miri $flags: $*"
    check env "MIRIFLAGS=-Zmiri-disable-isolation -Zmiri-tree-borrows $flags" CARGO_TARGET_DIR="$folder/miri" \
        cargo +nightly miri test --locked -p rigid-ccd-c --test it -- "$@"
}

mkdir -p "$folder"
write_missing | cc -fno-builtin -O1 -c -x c - -o "$folder/missing.o"
for name in $steps; do
    case $name in
    address) sanitise address address,undefined ;;
    thread) sanitise thread thread ;;
    miri)
        run_miri "" arguments::null arguments::a_place arguments::freeing
        # Meshes and robots start threads of rayon, which outlive the tests, so leaks are ignored.
        run_miri -Zmiri-ignore-leaks arguments::numbers arguments::prepared cells::cells_keep cells::names cells::a_joint \
            cells::too_many paths::a_flag
        skip "miri: leaks of meshes and robots, which the address sanitiser sees"
        ;;
    *) echo "no step: $name" >&2; exit 2 ;;
    esac
done

step "done"
for what in "${skipped[@]}"; do echo "skipped: $what"; done
for what in "${found[@]}"; do echo "FAILED: $what" >&2; done
[ ${#found[@]} = 0 ]
