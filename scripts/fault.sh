#!/usr/bin/env bash
# Harms the service while clients use it, and checks what it promised them. Needs a built tree (PRESET, default release).
#   scripts/fault.sh kills [N]      kills the service N times (200), and as often one of its runners
#   scripts/fault.sh analyses [N]   has the service compute N (1000) hostile analyses among ordinary ones
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build="build/${PRESET:-release}"
case "${1:-}" in
  kills) filter='Crash.*' variable="KILLS=${2:-200}" ;;
  analyses) filter='HostileAnalysis.*' variable="HOSTILE=${2:-1000}" ;;
  *) sed -n '2,4s/^# *//p' "$0" >&2; exit 2 ;;
esac
env "$variable" "$build/tests/fault_tests" --gtest_filter="$filter" --gtest_output="json:$build/fault.json"
python3 scripts/lib/recorded.py "$build/fault.json"
