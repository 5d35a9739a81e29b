#!/usr/bin/env bash
# tour.sh [MINUTES [SEED [PRESET]]]: walks through the window at random, on a display that nobody sees,
# and prints each step before it is taken (default: 10 minutes, seed 1, preset asan). Ends with an
# error if the program died, got stuck, or OpenGL complained; the same seed chooses the same steps.
set -euo pipefail
cd "$(dirname "$0")/.."
minutes=${1:-10}
seed=${2:-1}
preset=${3:-asan}

scripts/build.sh "$preset" test_window
export ENCORE_TOUR_MINUTES=$minutes ENCORE_TOUR_SEED=$seed ENCORE_NEED_GL=1
export LSAN_OPTIONS=${LSAN_OPTIONS:-suppressions=$PWD/tests/lsan.supp:print_suppressions=0}
export TSAN_OPTIONS=${TSAN_OPTIONS:-suppressions=$PWD/tests/tsan.supp:print_suppressions=0}
exec "build/$preset/tests/test_window" --gtest_also_run_disabled_tests --gtest_filter='*DISABLED_Tour'
