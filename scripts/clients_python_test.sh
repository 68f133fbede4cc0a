#!/usr/bin/env bash
# Tests of the Python package: generated files, library, service, sweeps, types, installation, notebook, pages.
#   scripts/clients_python_test.sh [BUILD_FOLDER]     default: build/release, with snapthrough and libsnapthrough.so.1
# scripts/engines_test.sh has the engines (Dask, MPI, joblib, Slurm), clients/python/bench_overhead.py the times.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

# What the package's tests need; the package itself needs python3 only.
PYTHON_PACKAGES=(python3 mypy python3-numpy python3-pandas python3-matplotlib python3-tqdm jupyter-nbconvert
  python3-ipykernel python3-setuptools python3-wheel python3-build python3-pip openssl)
install_packages "${PYTHON_PACKAGES[@]}"

BUILD_FOLDER="$(realpath "${1:-build/release}")"
export BUILD_FOLDER
for file in snapthrough libsnapthrough.so.1; do
  if [ ! -e "$BUILD_FOLDER/$file" ]; then
    echo "$BUILD_FOLDER/$file is not there: cmake --build $BUILD_FOLDER --target snapthrough snapthrough_shared" >&2
    exit 1
  fi
done
cd clients/python
/usr/bin/python3 generate.py
/usr/bin/python3 -W error::ResourceWarning -m unittest discover --start-directory tests --top-level-directory . "${@:2}"
