#!/usr/bin/env bash
# Makes docs/page/*.png from the running page: the pictures that tests/web/pictures.test.mjs compares with it.
#   scripts/web_pictures.sh [executable]     default: build/release/snapthrough
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

if [ -z "${CHROMIUM:-}" ] && ! command -v chromium >/dev/null; then
  install_packages "${PAGE_PACKAGES[@]}"
fi
SERVICE_EXECUTABLE="$(realpath "${1:-build/release/snapthrough}")"
export SERVICE_EXECUTABLE
cd tests/web
npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
rm -f ../../docs/page/*.png
node pictures.mjs
