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
