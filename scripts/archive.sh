#!/usr/bin/env bash
# Builds dist/snapthrough-VERSION-linux-x86_64.tar.gz, in place of one that is there: the program with everything that it needs,
# for any Linux on x86-64 that has /bin/sh. scripts/archive_test.sh tries the archive.
#   scripts/archive.sh
# JOBS=n compiles that many files at a time. SOURCE_DATE_EPOCH sets the dates inside; by default that of the commit.
# SNAPTHROUGH_BUILD names the commit where the sources have no repository.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
install_packages "${BUILD_PACKAGES[@]}" python3 binutils

version="$(sed -n 's/^project(snapthrough VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
name="snapthrough-$version-linux-x86_64"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
root="$work/$name"
mkdir -p "$root/bin" "$root/lib"

for pair in portable-x86-64-v2:x86-64-v2 release:x86-64-v3; do
  build="build/${pair%%:*}"
  mkdir -p "$build"
  cmake --preset "${pair%%:*}" -D SNAPTHROUGH_BUILD="${SNAPTHROUGH_BUILD:-}" >"$build/configure.log" 2>&1 || { cat "$build/configure.log"; exit 1; }
  cmake --build "$build" --target snapthrough pages --parallel "${JOBS:-$(nproc)}"
  strip -o "$root/lib/snapthrough-${pair#*:}" "$build/snapthrough"
done

# The libraries, the loader of Linux among them: none of the machine is used, whatever its distribution.
ldd build/release/snapthrough | grep -o '/[^ ]*' | while read -r library; do
  cp -L "$library" "$root/lib/"
done
install -m 755 clients/archive/snapthrough "$root/bin/snapthrough"
cp -r build/release/pages "$root/share"
rm -f "$root/share/made"
cp LICENSE clients/archive/README.txt "$root/"
python3 scripts/lib/sbom.py "$name" "$version" "$root"

if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then
  SOURCE_DATE_EPOCH="$(git log -1 --format=%ct 2>/dev/null || date +%s)"
fi
mkdir -p dist
rm -f dist/snapthrough-*-linux-x86_64.tar.gz
tar -C "$work" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --mode=go-w -cf - "$name" |
  gzip -9n >"dist/$name.tar.gz"
ls -l "dist/$name.tar.gz"
