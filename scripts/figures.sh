#!/usr/bin/env bash
# Makes the pictures under docs/ anew, all in the style of `snapthrough plot`.
#   scripts/figures.sh [GROUP...]     all of them (some minutes), or those of the groups that --list names
#   scripts/figures.sh --list         each picture with what makes it; exit status 1 when nothing makes one, or one is missing
#   scripts/figures.sh --sheet DIR    shows them: DIR/index.html, and PNG files of twelve pictures each, by Chromium
# SNAPTHROUGH names the program that draws; without it build/release/snapthrough is built first.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

case "${1:-}" in
  -h | --help)
    sed -n '2,6s/^# \{0,1\}//p' scripts/figures.sh
    exit
    ;;
  --list)
    exec python3 scripts/figures.py --list
    ;;
  --sheet)
    if [ -z "${CHROMIUM:-}" ] && ! command -v chromium >/dev/null; then
      install_packages "${PAGE_PACKAGES[@]}"
    fi
    exec python3 scripts/figures.py "$@"
    ;;
esac

install_packages "${REPORT_PACKAGES[@]}" "${FIGURE_PACKAGES[@]}"
if [ -z "${SNAPTHROUGH:-}" ]; then
  install_packages "${BUILD_PACKAGES[@]}"
  mkdir -p build/release
  log=build/release/figures.log
  cmake --preset release >"$log" 2>&1 || { cat "$log"; exit 1; }
  cmake --build build/release --parallel "${JOBS:-$(nproc)}" --target snapthrough >"$log" 2>&1 || { cat "$log"; exit 1; }
  SNAPTHROUGH=build/release/snapthrough
fi
exec python3 scripts/figures.py --program "$SNAPTHROUGH" "$@"
