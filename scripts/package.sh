#!/usr/bin/env bash
# Builds the Debian packages into build/package/packages and has lintian look at them.
#   scripts/package.sh
# JOBS=n compiles that many files at a time. VERSION=x.y.z packs the same program under another version. They are built
# for x86-64-v2, which every processor of the last fifteen years has; see docs/howto/install-the-package.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
install_packages "${BUILD_PACKAGES[@]}" python3 dpkg-dev lintian

# Packages of the same commit have the same dates inside.
if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then
  SOURCE_DATE_EPOCH="$(git log -1 --format=%ct 2>/dev/null || date +%s)"
fi
export SOURCE_DATE_EPOCH
# Debian's own flags: fortified, with protected stacks, bound at the start. No debugging information: it isn't packed.
export DEB_BUILD_MAINT_OPTIONS=hardening=+all DEB_CXXFLAGS_MAINT_STRIP=-g
CXXFLAGS="$(dpkg-buildflags --get CPPFLAGS) $(dpkg-buildflags --get CXXFLAGS)"
LDFLAGS="$(dpkg-buildflags --get LDFLAGS)"
export CXXFLAGS LDFLAGS
options=(-DSNAPTHROUGH_PACKAGE=ON -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_LIBDIR="lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)"
  -DSNAPTHROUGH_ARCH=x86-64-v2 -DSNAPTHROUGH_WERROR=OFF -DBUILD_TESTING=OFF -DSNAPTHROUGH_BENCH=OFF
  -DSNAPTHROUGH_PACKAGE_VERSION="${VERSION:-}")
cmake --preset release -B build/package "${options[@]}" >/dev/null
cmake --build build/package --parallel "${JOBS:-$(nproc)}"
rm -rf build/package/packages
(cd build/package && cpack -G DEB >/dev/null)
lintian --fail-on error --suppress-tags-from-file docker/debian/lintian-ignored build/package/packages/*.deb
ls -l build/package/packages/*.deb
