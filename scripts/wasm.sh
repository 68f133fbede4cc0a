#!/usr/bin/env bash
# Builds the solver for WebAssembly, as the npm package snapthrough-solver in build/wasm/package, and tests it in Node.
#   scripts/wasm.sh             installs the compiler where it is missing, builds, and tests against build/release/snapthrough
#   scripts/wasm.sh --build     builds the package without testing it
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

install_packages "${WASM_PACKAGES[@]}"
mkdir -p build/wasm
cmake --preset wasm >build/wasm/configure.log 2>&1 || { cat build/wasm/configure.log; exit 1; }
cmake --build build/wasm --parallel "${JOBS:-$(nproc)}"
package=build/wasm/package
rm -rf "$package"
cp -r clients/wasm/package "$package"
cp build/wasm/snapthrough.wasm "$package/"
printf '%s: %s bytes, %s with gzip\n' "$package/snapthrough.wasm" "$(stat -c %s "$package/snapthrough.wasm")" \
  "$(gzip -9 -c "$package/snapthrough.wasm" | wc -c)"
if [ "${1:-}" != --build ]; then
  SERVICE_EXECUTABLE="$(realpath build/release/snapthrough)" SOLVER_PACKAGE="$package" node --test tests/clients/wasm/*.test.mjs
fi
