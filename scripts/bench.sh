#!/usr/bin/env bash
# Installs what is missing, builds the benchmarks, runs them and writes docs/performance/ (tables and SVG plots).
#   scripts/bench.sh                          everything, some minutes
#   scripts/bench.sh --benchmark_min_time=1   options are passed on to Google Benchmark
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" "${REPORT_PACKAGES[@]}"
cmake --preset release >/dev/null
cmake --build build/release --parallel "${JOBS:-$(nproc)}" --target bench_performance
build/release/bench/bench_performance --benchmark_min_time=0.2 --benchmark_out=build/release/performance.json \
  --benchmark_out_format=json "$@"
python3 scripts/bench_report.py build/release/performance.json
