#!/usr/bin/env bash
# Kills the service N times (200), and as often a runner, while clients use it, and checks what it promised them. Needs a built tree.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
report="build/${PRESET:-release}/crash.json"
KILLS="${1:-200}" "build/${PRESET:-release}/tests/fault_tests" --gtest_filter='Crash.*' --gtest_output="json:$report"
python3 scripts/lib/recorded.py "$report"
