#!/usr/bin/env bash
# Renders the pictures of the README anew, from the sample scenes.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh release encore
mkdir -p docs/images
encore=build/release/app/encore
$encore render toys --size 512 --out docs/images/toys.png
$encore render dragon --size 512 --out docs/images/dragon.png
$encore render dragon --size 512 --heatmap steps --out docs/images/dragon-steps.png
$encore render forest --size 768x512 --out docs/images/forest.png
$encore render mirrors --samples 16 --size 768x512 --out docs/images/mirrors.png

# The window's, as someone sees it who uses it: on a display of its own.
if ! command -v Xvfb >/dev/null; then
  echo "make-pictures.sh: the pictures of the window stay as they are: there is no Xvfb (Debian: apt install xvfb)" >&2
  exit 0
fi
scripts/build.sh release test_window
ENCORE_PICTURES=$PWD/docs/images ENCORE_NEED_GL=1 build/release/tests/test_window \
  --gtest_also_run_disabled_tests --gtest_filter='ReadmePictures.DISABLED_*'
