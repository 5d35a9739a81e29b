#!/usr/bin/env bash
# Installs the Debian packages of scripts/packages.txt that are missing. Asks before using sudo,
# runs as root without it, and does nothing (and needs no network) if all are there.
set -euo pipefail
cd "$(dirname "$0")/.."

mapfile -t wanted < <(grep -v '^#' scripts/packages.txt)
missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if ! command -v apt-get >/dev/null; then
  echo "This script installs packages with apt-get (Debian 12, Ubuntu). Elsewhere, install the" >&2
  echo "equivalents of: ${missing[*]}" >&2
  exit 1
fi

echo "Missing packages: ${missing[*]}" >&2
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "Install them as root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  if [ -t 0 ]; then
    read -r -p "Install them with sudo apt-get? [y/N] " answer
    [[ $answer == [yY]* ]] || { echo "Nothing was installed." >&2; exit 1; }
  else
    echo "Run this from a terminal to confirm the use of sudo, or as root:" >&2
    echo "  apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"
