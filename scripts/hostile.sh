#!/usr/bin/env bash
# Has the service compute N (1000) hostile analyses among ordinary ones, and checks that only they fail. Needs a built tree.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
report="build/${PRESET:-release}/hostile.json"
HOSTILE="${1:-1000}" "build/${PRESET:-release}/tests/fault_tests" --gtest_filter='HostileAnalysis.*' --gtest_output="json:$report"
python3 scripts/lib/recorded.py "$report"
