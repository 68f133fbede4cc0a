#!/usr/bin/env bash
# Installs what is missing, builds, and runs every check and test of the project.
#   scripts/test.sh                 the release build
#   PRESET=asan scripts/test.sh     another preset of CMakePresets.json (dev, release, asan, tsan)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
preset="${PRESET:-release}"
jobs="${JOBS:-$(nproc)}"

install_packages "${BUILD_PACKAGES[@]}" "${RUN_PACKAGES[@]}" "${TEST_PACKAGES[@]}"

echo "== shape, includes, links, format"
python3 scripts/check_shape.py --self-test
python3 scripts/check_shape.py
python3 scripts/check_includes.py --self-test
python3 scripts/check_includes.py
python3 scripts/check_links.py --self-test
python3 scripts/check_links.py
bash scripts/format.sh --check

echo "== build ($preset)"
mkdir -p "build/$preset"
log="build/$preset/configure.log"
options=(-DBUILD_TESTING=ON)
if [ "$preset" = release ] || [ "$preset" = dev ]; then
  options+=(-DSNAPTHROUGH_BENCH=ON)  # scripts/run.sh leaves tests and benchmarks out of the same folder
fi
cmake --preset "$preset" "${options[@]}" >"$log" 2>&1 || { cat "$log"; exit 1; }
cmake --build "build/$preset" --parallel "$jobs"

echo "== tests"
ctest --test-dir "build/$preset" --parallel "$jobs" --output-on-failure --no-tests=error

echo "== schema, generated client, responses"
bash scripts/schema.sh "build/$preset/snapthrough"

echo "== page: types, bundle byte for byte, figures, in Chromium"
bash scripts/web.sh --check
bash scripts/web_test.sh "build/$preset/snapthrough"

echo "== thesis examples"
python3 scripts/report.py --self-test
python3 scripts/report.py "build/$preset/snapthrough" --check
