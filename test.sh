#!/usr/bin/env bash
# Installs what is missing, builds a release and runs every test. Arguments go to ctest:
#   ./test.sh -R Grid     only the tests whose name matches
set -euo pipefail
root=$(cd "$(dirname "$0")" && pwd)

"$root/scripts/install-packages.sh"
"$root/scripts/build.sh" release
cd "$root"
exec ctest --preset release --parallel "$(nproc)" "$@"
