#!/usr/bin/env bash
# Builds dist/snapthrough-VERSION-py3-none-manylinux_2_17_x86_64.whl: the Python package with the library inside, for Linux with
# glibc 2.17 or later; the processor decides which of two libraries is taken. Then solves with it what tests/clients has.
#   scripts/wheel.sh
# JOBS=n compiles that many files at a time. SOURCE_DATE_EPOCH sets the dates inside; by default that of the commit.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
install_packages "${BUILD_PACKAGES[@]}" python3 python3-setuptools python3-wheel python3-pip python3-venv binutils

libraries=""
for pair in release:x86-64-v3 portable-x86-64-v2:x86-64-v2; do
  preset="${pair%%:*}"
  mkdir -p "build/$preset"
  cmake --preset "$preset" >"build/$preset/configure.log" 2>&1 || { cat "build/$preset/configure.log"; exit 1; }
  cmake --build "build/$preset" --target snapthrough_portable --parallel "${JOBS:-$(nproc)}"
  library="$(realpath "build/$preset/portable/libsnapthrough.so.1")"
  libraries+="${pair#*:}=$library;"
  # What the library asks of glibc must be what the name of the wheel promises.
  newest="$(objdump -T "$library" | grep -o 'GLIBC_[0-9.]*' | sort -Vu | tail -1)"
  if [ "$(printf '%s\n' "$newest" GLIBC_2.17 | sort -V | tail -1)" != GLIBC_2.17 ]; then
    echo "$library asks for $newest, the wheel promises GLIBC_2.17" >&2
    exit 1
  fi
done

if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then
  SOURCE_DATE_EPOCH="$(git log -1 --format=%ct 2>/dev/null || date +%s)"
fi
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
export SOURCE_DATE_EPOCH PYTHONSNAPTHROUGH_LIBRARIES="$libraries" PYTHONSNAPTHROUGH_PLATFORM=manylinux_2_17_x86_64
(cd clients/python && umask 022 && /usr/bin/python3 setup.py --quiet build --build-base "$work/build" \
  bdist_wheel --bdist-dir "$work/bdist" --dist-dir "$work/dist")
mkdir -p dist
mv "$work"/dist/*.whl dist/
wheel="$(ls -t dist/snapthrough-*manylinux*.whl | head -1)"
ls -l "$wheel"

# As somebody who has nothing but Python.
/usr/bin/python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --no-index "$wheel"
mkdir "$work/out"
"$work/venv/bin/python" -I tests/clients/native/solve.py "$work/out" tests/clients/requests/*.json tests/clients/sweep_500.json \
  >"$work/told"
cmake --build build/release --target snapthrough --parallel "${JOBS:-$(nproc)}" >/dev/null
/usr/bin/python3 tests/clients/native/compare.py build/release/snapthrough "$work/out" <"$work/told"
