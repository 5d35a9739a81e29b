#!/usr/bin/env bash
# soak.sh [MINUTES [PRESET]]: draws the moving sample scenes with every structure, policy, device,
# intersection mode and kind of ray, again and again, under a sanitizer (default: 60 minutes, preset
# asan). Prints a line a minute and in the end a verdict. Ends with an error if a hit or picture was
# wrong, if memory drifted, if something leaked, or if the sanitizer complained.
# ENCORE_SOAK_OPTIONS: further options of encore_soak, as in --no-opengl or "--seed 2".
set -euo pipefail
cd "$(dirname "$0")/.."
minutes=${1:-60}
preset=${2:-asan}

scripts/build.sh "$preset" encore_soak
# Freed memory is kept back from reuse for a while, to see who still uses it: 16 MiB of it, so that
# resident memory settles within a few rounds.
export ASAN_OPTIONS=${ASAN_OPTIONS:-quarantine_size_mb=16:detect_stack_use_after_return=1}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
export LSAN_OPTIONS=${LSAN_OPTIONS:-suppressions=$PWD/tests/lsan.supp:print_suppressions=0}
export TSAN_OPTIONS=${TSAN_OPTIONS:-suppressions=$PWD/tests/tsan.supp:print_suppressions=0}
read -ra options <<<"${ENCORE_SOAK_OPTIONS:-}"
exec "build/$preset/tests/encore_soak" --minutes "$minutes" "${options[@]}"
