#!/usr/bin/env bash
# build.sh PRESET [TARGET …]: configures (only the first time) and builds.
# CMAKE_OPTIONS may hold further options for the configuration, as in CMAKE_OPTIONS=-DENCORE_WERROR=ON.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift

log=build/$preset/configure.log
if [ ! -f "build/$preset/build.ninja" ]; then
  mkdir -p "build/$preset"
  echo "Configuring ($preset) …" >&2
  if ! cmake --preset "$preset" ${CMAKE_OPTIONS:-} >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "build/$preset/build.ninja"
    exit 1
  fi
fi
targets=()
for target in "$@"; do targets+=(--target "$target"); done
cmake --build --preset "$preset" "${targets[@]}" >&2
