#!/usr/bin/env bash
# Tests the page: its figures on stored results, and all of it in Chromium against the executable; and the JavaScript client in Node.
#   scripts/web_test.sh [executable]     default: build/release/snapthrough; CHROMIUM names another browser
# scripts/web.sh has to have run: the figures' tests use its packages.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

if [ -z "${CHROMIUM:-}" ] && ! command -v chromium >/dev/null; then
  install_packages "${PAGE_PACKAGES[@]}"
fi
SERVICE_EXECUTABLE="$(realpath "${1:-build/release/snapthrough}")"
export SERVICE_EXECUTABLE
node tests/web/figures/run.mjs
node --test tests/clients/js/*.test.mjs
cd tests/web
# The lock file fixes every package by its hash.
npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
npm test --silent
