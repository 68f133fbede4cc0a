#!/usr/bin/env bash
# Builds a wheel of the Python package into dist/, with the library inside, and solves with that what tests/clients has.
#   scripts/wheel.sh [x86_64]    Linux on x86-64 with glibc 2.17 or later; the processor decides which of two libraries is taken
#   scripts/wheel.sh aarch64     Linux on 64-bit ARM with glibc 2.17 or later; its library is tried under emulation, by a C program
#   scripts/wheel.sh windows     Windows on x86-64; its library is tried under wine, by a C program
#   scripts/wheel.sh none        without a library: for a service, and for Python in a browser (Pyodide), in which it is tried
# JOBS=n compiles that many files at a time. SOURCE_DATE_EPOCH sets the dates inside; by default that of the commit.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

target="${1:-x86_64}"
file=portable/libsnapthrough.so.1
case "$target" in
  x86_64)
    packages=()
    builds=(release:x86-64-v3 portable-x86-64-v2:x86-64-v2)
    platform=manylinux_2_17_x86_64
    ;;
  aarch64)
    packages=(g++-aarch64-linux-gnu qemu-user)
    builds=(portable-aarch64:any)
    platform=manylinux_2_17_aarch64
    ;;
  windows)
    packages=(g++-mingw-w64-x86-64-posix wine64)
    builds=(portable-windows:any)
    platform=win_amd64
    file=portable/snapthrough.dll
    ;;
  none)
    packages=()
    if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
      packages=("${SCHEMA_PACKAGES[@]}")
    fi
    builds=()
    platform=any
    ;;
  *)
    echo "usage: scripts/wheel.sh [x86_64 | aarch64 | windows | none]" >&2
    exit 1
    ;;
esac
install_packages "${BUILD_PACKAGES[@]}" python3 python3-setuptools python3-wheel python3-pip python3-venv binutils "${packages[@]}"

libraries=""
for pair in "${builds[@]}"; do
  build="build/${pair%%:*}"
  mkdir -p "$build"
  cmake --preset "${pair%%:*}" >"$build/configure.log" 2>&1 || { cat "$build/configure.log"; exit 1; }
  cmake --build "$build" --target snapthrough_portable --parallel "${JOBS:-$(nproc)}"
  library="$PWD/$build/$file"
  libraries+="${pair#*:}=$library;"
  # What the library asks of glibc must be what the name of the wheel promises.
  if [ "$target" != windows ]; then
    newest="$(readelf -W --dyn-syms "$library" | grep -o 'GLIBC_[0-9.]*' | sort -Vu | tail -1)"
    if [ "$(printf '%s\n' "$newest" GLIBC_2.17 | sort -V | tail -1)" != GLIBC_2.17 ]; then
      echo "$library asks for $newest, the wheel promises GLIBC_2.17" >&2
      exit 1
    fi
  fi
done

if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then
  SOURCE_DATE_EPOCH="$(git log -1 --format=%ct 2>/dev/null || date +%s)"
fi
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
export SOURCE_DATE_EPOCH PYTHONSNAPTHROUGH_LIBRARIES="${libraries:-none}" PYTHONSNAPTHROUGH_PLATFORM="$platform"
(cd clients/python && umask 022 && /usr/bin/python3 setup.py --quiet build --build-base "$work/build" \
  bdist_wheel --bdist-dir "$work/bdist" --dist-dir "$work/dist")
mkdir -p dist
mv "$work"/dist/*.whl dist/
wheel="$(find dist -name "snapthrough-*$platform.whl" | head -1)"
ls -l "$wheel"

if [ "$target" = none ]; then
  [ -f build/wasm/package/snapthrough.wasm ] || bash scripts/wasm.sh --build
  export WHEEL="$PWD/$wheel" SOLVER_PACKAGE="$PWD/build/wasm/package"
  cd tests/clients/pyodide
  # The lock file fixes every package by its hash.
  npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
  node --test
  exit
fi

requests=(tests/clients/requests/*.json tests/clients/sweep_500.json)
mkdir "$work/out"
/usr/bin/python3 -m zipfile -e "$wheel" "$work/wheel"
native="$(find "$work/wheel" -name "$(basename "$file")" | head -1)"
case "$target" in
  x86_64)  # as somebody who has nothing but Python
    /usr/bin/python3 -m venv "$work/venv"
    "$work/venv/bin/pip" install --quiet --no-index "$wheel"
    "$work/venv/bin/python" -I tests/clients/native/solve.py "$work/out" "${requests[@]}" >"$work/told"
    ;;
  aarch64)
    aarch64-linux-gnu-gcc -std=c11 -O1 -I. -o "$work/solve" tests/clients/native/solve.c
    qemu-aarch64 -L /usr/aarch64-linux-gnu "$work/solve" "$native" "$work/out" "${requests[@]}" >"$work/told"
    ;;
  windows)
    x86_64-w64-mingw32-gcc-posix -std=c11 -O1 -I. -o "$work/solve.exe" tests/clients/native/solve.c
    WINEPREFIX="$work/wine" WINEDEBUG=-all /usr/lib/wine/wine64 "$work/solve.exe" "$native" "$work/out" "${requests[@]}" | tr -d '\r' >"$work/told"
    ;;
esac
cmake --build build/release --target snapthrough --parallel "${JOBS:-$(nproc)}" >/dev/null
/usr/bin/python3 tests/clients/native/compare.py build/release/snapthrough "$work/out" <"$work/told"
