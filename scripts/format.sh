#!/usr/bin/env bash
# Formats the C++ sources with clang-format, or with --check only says which differ (exit status 1).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
shopt -s globstar nullglob
files=({solver,api,server,tests,bench}/**/*.{h,cpp})
if [ "${#files[@]}" -eq 0 ]; then
  exit 0
fi
if [ "${1:-}" = --check ]; then
  clang-format --dry-run --Werror "${files[@]}"
  echo "format: ${#files[@]} files are formatted"
else
  clang-format -i "${files[@]}"
fi
