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

# step NAME: what follows is this step; told at the end with the seconds that each took.
steps=()
step() {
  steps+=("$SECONDS $1")
  echo "== $1"
}
tell_steps() {
  local i next
  steps+=("$SECONDS end")
  echo "== where the time went"
  for ((i = 0; i + 1 < ${#steps[@]}; i++)); do
    next="${steps[i + 1]%% *}"
    printf '%6d s  %s\n' $((next - ${steps[i]%% *})) "${steps[i]#* }"
  done
}
trap tell_steps EXIT

step "packages"
install_packages "${BUILD_PACKAGES[@]}" "${RUN_PACKAGES[@]}" "${TEST_PACKAGES[@]}"

step "shape, includes, links, words, spelling, format"
python3 scripts/check_shape.py --self-test
python3 scripts/check_shape.py
python3 scripts/check_includes.py --self-test
python3 scripts/check_includes.py
python3 scripts/check_circles.py --self-test
python3 scripts/check_circles.py
python3 scripts/check_links.py --self-test
python3 scripts/check_links.py
python3 scripts/check_words.py --self-test
python3 scripts/check_words.py
python3 scripts/check_code_blocks.py --self-test
python3 scripts/figures.py --self-test
python3 scripts/try_limits.py --self-test
bash scripts/figures.sh --list >/dev/null
codespell README.md CONTRIBUTING.md CHANGELOG.md docs examples solver api server scripts
bash scripts/format.sh --check

step "build ($preset)"
mkdir -p "build/$preset"
log="build/$preset/configure.log"
cmake --preset "$preset" >"$log" 2>&1 || { cat "$log"; exit 1; }
cmake --build "build/$preset" --parallel "$jobs"
cmake --build "build/$preset" --parallel "$jobs" --target all_verify_interface_header_sets

step "clang-tidy of what the last commit changed"
if [ "$preset" = release ]; then
  bash scripts/tidy.sh --changed
fi

step "tests"
ctest --test-dir "build/$preset" --parallel "$jobs" --output-on-failure --no-tests=error

# The steps from here to WebAssembly use one processor each; its build takes the others.
wasm_log=build/wasm_build.log
wasm_build=""
if [ "$preset" = release ]; then
  install_packages "${WASM_PACKAGES[@]}"
  nice -n 10 bash scripts/wasm.sh --build >"$wasm_log" 2>&1 &
  wasm_build=$!
fi

step "schema, generated client, responses"
bash scripts/schema.sh "build/$preset/snapthrough"

step "page: types, shape, bundle byte for byte"
bash scripts/web.sh --check
step "page: figures, and in Chromium"
bash scripts/web_test.sh "build/$preset/snapthrough"

step "Python client"
bash scripts/clients_python_test.sh "build/$preset"

step "tools for language models, by the protocol's client"
bash scripts/mcp_test.sh "build/$preset/snapthrough"

step "WebAssembly, in Node, and in Python in WebAssembly"
if [ "$preset" = release ]; then
  wait "$wasm_build" || { cat "$wasm_log"; exit 1; }
  bash scripts/wasm.sh
  bash scripts/wheel.sh none
fi

step "page without a service, in Chromium"
if [ "$preset" = release ]; then
  site="$(mktemp -d)"
  bash scripts/site.sh "$site/site"
  (cd tests/web && SITE="$site/site" node --test static.test.mjs)
  rm -rf "$site"
fi

step "commands of the documents, and the script of the theory"
python3 scripts/check_code_blocks.py "build/$preset/snapthrough"
/usr/bin/python3 docs/theory/shallow_arch.py
/usr/bin/python3 docs/theory/lees_frame.py

step "thesis examples and gallery"
python3 scripts/report.py --self-test
python3 scripts/report.py "build/$preset/snapthrough" --check

step "scripts/run.sh: a real analysis through the service"
if [ "$preset" = release ]; then
  PORT=18099 bash scripts/run.sh --once
fi
