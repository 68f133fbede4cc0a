#!/usr/bin/env bash
# Runs clang-tidy with .clang-tidy over the sources of a configured build. Slow (minutes), so it is not part of CI.
#   scripts/tidy.sh [FILE...]      default: every .cpp of solver, api and server
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
preset="${PRESET:-release}"
# Version 16: version 14, Debian's default, fails on <ranges> in C++20.
install_packages "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" clang-tidy-16
if [ ! -f "build/$preset/compile_commands.json" ]; then
  cmake --preset "$preset" >/dev/null
fi
if [ "$#" -gt 0 ]; then
  files=("$@")
else
  mapfile -t files < <(find solver api server -name '*.cpp' | sort)
fi
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-16 --quiet -p "build/$preset"
