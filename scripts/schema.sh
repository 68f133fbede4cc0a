#!/usr/bin/env bash
# Checks the published document with a linter, a generated client, responses of the service and random requests.
#   scripts/schema.sh [executable]     default: build/release/snapthrough
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  install_packages "${SCHEMA_PACKAGES[@]}"
fi
SERVICE_EXECUTABLE="$(realpath "${1:-build/release/snapthrough}")"
export SERVICE_EXECUTABLE
cd tests/schema
# The lock file fixes every package by its hash.
npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
npm test
