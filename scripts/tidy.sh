#!/usr/bin/env bash
# Runs clang-tidy with .clang-tidy over sources, with the options of a build without precompiled headers: those of GCC
# are none of clang's.
#   scripts/tidy.sh [FILE...]        default: every .cpp of solver, api and server (slow: half an hour)
#   scripts/tidy.sh --changed [REF]  those that changed since REF (default: the commit before the last), in CI; of
#                                    more than 12 the first 12, with the number of those left out
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
preset="${PRESET:-release}"
most_changed=12  # some two minutes on two cores
# the preset does not compile clients/wasm
sources=('solver/*.cpp' 'api/*.cpp' 'server/*.cpp' 'clients/*.cpp' ':!clients/wasm')
files=("$@")
if [ "${1:-}" = --changed ]; then
  ref="${2:-HEAD~1}"
  if ! git rev-parse --quiet --verify "$ref^{commit}" >/dev/null; then
    echo "tidy: no $ref here to compare with"
    exit 0
  fi
  mapfile -t files < <(git diff --name-only --diff-filter=AMR "$ref" -- "${sources[@]}")
  if [ "${#files[@]}" -eq 0 ]; then
    echo "tidy: no source of solver, api, server or clients changed since $ref"
    exit 0
  fi
  if [ "${#files[@]}" -gt "$most_changed" ]; then
    echo "tidy: $((${#files[@]} - most_changed)) of ${#files[@]} changed files are left out; scripts/tidy.sh takes all"
    files=("${files[@]:0:most_changed}")
  fi
elif [ "${#files[@]}" -eq 0 ]; then
  mapfile -t files < <(git ls-files "${sources[@]}")
fi
# Version 16: version 14, Debian's default, fails on <ranges> in C++20.
install_packages "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" clang-tidy-16
cmake --preset "$preset" -B build/tidy -DSNAPTHROUGH_PCH=OFF -DBUILD_TESTING=OFF -DSNAPTHROUGH_BENCH=OFF >/dev/null

printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-16 --quiet -p build/tidy
echo "tidy: ${#files[@]} files, nothing found"
