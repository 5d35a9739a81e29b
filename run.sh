#!/usr/bin/env bash
# Installs what is missing, builds a release and runs it with what is given.
#   ./run.sh                     open the window; without a display, profile the default scene quickly
#   ./run.sh profile bunny.ply   any command of the program, with its options
set -euo pipefail
root=$(cd "$(dirname "$0")" && pwd)

"$root/scripts/install-packages.sh"
"$root/scripts/build.sh" release encore

if [ $# -eq 0 ] && [ -z "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  set -- profile --plan quick
fi
exec "$root/build/release/app/encore" "$@"
