#!/usr/bin/env bash
# Draws the icons of fixed size anew from encore.svg (needs rsvg-convert, Debian's librsvg2-bin).
set -euo pipefail
cd "$(dirname "$0")"
for side in 16 32 48 64 128 256 512; do
  mkdir -p "icons/${side}x${side}"
  rsvg-convert --width "$side" --height "$side" encore.svg --output "icons/${side}x${side}/encore.png"
done
