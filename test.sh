#!/usr/bin/env bash
# Installs what is missing, builds a release and runs every test. If nothing has changed since all of
# them passed, it says so and shows that run's summary instead. Arguments go to ctest:
#   ./test.sh -R Grid     only the tests whose name matches
#   ./test.sh --again     all of them, whatever has changed
set -euo pipefail
root=$(cd "$(dirname "$0")" && pwd)

"$root/scripts/install-packages.sh"
"$root/scripts/build.sh" release
cd "$root"

again=no
if [ "${1:-}" = "--again" ]; then
  again=yes
  shift
fi
if [ $# -gt 0 ]; then
  exec ctest --preset release --parallel "$(nproc)" "$@"
fi

# What a test may depend on: every file of the project, what was built, and the models beside it.
state() {
  find . \( -path ./build -o -path ./.git \) -prune -o -type f -print0 | sort -z | xargs -0 sha256sum
  stat -c '%n %s %Y' build/release/tests/test_* build/release/app/encore
  ls -d ../shared/models 2>/dev/null || true
}
passed=build/release/tests-passed
now=$(state | sha256sum)
if [ $again = no ] && [ -f "$passed" ] && [ "$(head -n 1 "$passed")" = "$now" ]; then
  echo "Nothing has changed since every test passed (./test.sh --again runs them all the same):"
  tail -n +2 "$passed"
  exit 0
fi
rm -f "$passed"
log=build/release/tests.log
ctest --preset release --parallel "$(nproc)" 2>&1 | tee "$log"
{
  echo "$now"
  sed -n '/tests passed,/,$p' "$log"
} > "$passed"
