#!/usr/bin/env bash
# feature-cost.sh [SCENE [SIZE]]: what the features that a plain scene does not use cost it on the CPU.
# Counts the instructions of one frame (callgrind, one thread) of the tracer, and of one that never had
# the features (tests/bench/feature_cost.cpp), for three structures, and the heap that each holds
# besides its own object, which is of the same size in every scene.
# Fails if the tracer takes more than 2 % more instructions, holds other memory or draws another
# picture. ENCORE_FEATURE_COST: a built encore_feature_cost; default: that of the preset bench.
# On the device: tests/needs holds the generated shaders and what is sent to the same.
set -euo pipefail
cd "$(dirname "$0")/.."
scene=${1:-car}
size=${2:-128}

if ! command -v valgrind >/dev/null; then
  echo "feature-cost.sh: valgrind was not found, and instructions are counted by its tool callgrind;" \
    "install the package valgrind" >&2
  exit 1
fi
program=${ENCORE_FEATURE_COST:-}
if [ -z "$program" ]; then
  scripts/build.sh bench encore_feature_cost
  program=build/bench/tests/bench/encore_feature_cost
fi
# Small pieces that lie in a thread's cache would not be seen as heap.
export GLIBC_TUNABLES=glibc.malloc.tcache_count=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# instructions WHICH STRUCTURE: of one frame; its line of figures goes to $folder/WHICH.
instructions() {
  # Nothing is collected but what encore_frame() calls.
  valgrind --tool=callgrind --collect-atstart=no --toggle-collect=encore_frame \
    --callgrind-out-file="$folder/out" "$program" "$1" "$scene" "$2" "$size" \
    >"$folder/$1" 2>"$folder/log" || { cat "$folder/log" >&2; return 1; }
  awk '/^(summary|totals):/ { print $2; exit }' "$folder/out"
}

failed=0
printf '%-12s %14s %14s %8s %12s %12s  %s\n' structure 'plain instr.' 'tracer instr.' ratio \
  'plain heap B' 'tracer heap' picture
for structure in bvh-median grid-exact kd-sah; do
  plain=$(instructions plain "$structure")
  tracer=$(instructions tracer "$structure")
  read -r _ _ plain_heap _ plain_object _ plain_picture <"$folder/plain"
  read -r _ _ tracer_heap _ tracer_object _ tracer_picture <"$folder/tracer"
  ratio=$(awk -v a="$tracer" -v b="$plain" 'BEGIN { printf "%.4f", a / b }')
  picture=same
  if [ "$plain_picture" != "$tracer_picture" ]; then picture=DIFFERS; fi
  printf '%-12s %14s %14s %8s %12s %12s  %s\n' "$structure" "$plain" "$tracer" "$ratio" \
    "$plain_heap" "$tracer_heap" "$picture"
  if [ "$picture" != same ] || awk -v r="$ratio" 'BEGIN { exit !(r > 1.02) }'; then failed=1; fi
  if [ "$plain_heap" != "$tracer_heap" ]; then failed=1; fi
done
echo "The objects themselves: plain $plain_object B, tracer $tracer_object B."
if [ "$failed" != 0 ]; then
  echo "feature-cost.sh: more than 2 % more instructions, other memory or another picture" >&2
  exit 1
fi
