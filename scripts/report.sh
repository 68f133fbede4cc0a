#!/usr/bin/env bash
# Installs what is missing, builds the command line and writes docs/thesis/ anew.
#   scripts/report.sh [--check]     --check only compares the numbers
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${REPORT_PACKAGES[@]}"

mkdir -p build/release
log=build/release/report.log
cmake --preset release >"$log" 2>&1 || { cat "$log"; exit 1; }
cmake --build build/release --parallel "${JOBS:-$(nproc)}" --target snapthrough >"$log" 2>&1 || { cat "$log"; exit 1; }
python3 scripts/report.py build/release/snapthrough "$@"
