#!/usr/bin/env bash
# Builds the page and the JavaScript client: types from the interface's document, type check, bundle in web/dist, sizes,
# clients/js/dist.
#   scripts/web.sh            writes web/dist and clients/js/dist, which are committed but for types.d.ts
#   scripts/web.sh --check    builds them beside and compares every byte
#   scripts/web.sh --types    makes the types of the documents alone: clients/js/dist/types.d.ts
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  install_packages "${SCHEMA_PACKAGES[@]}"
fi
cd web
# The lock file fixes every package by its hash.
npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
case "${1:-}" in
  --types | --check | "") ;;
  *) echo "usage: scripts/web.sh [--check | --types]" >&2; exit 1 ;;
esac
npm run --silent types
if [ "${1:-}" = --types ]; then
  npm run --silent client
  exit
fi
npm run --silent check
if [ "${1:-}" = --check ]; then
  built="$(mktemp -d)"
  trap 'rm -rf "$built"' EXIT
  npm run --silent build -- "$built/dist"
  npm run --silent client -- "$built/client"
  diff -r "$built/dist" dist ||
    { echo "web/dist is not what web/src gives: run scripts/web.sh and commit it." >&2; exit 1; }
  diff -r --exclude=types.d.ts "$built/client" ../clients/js/dist ||
    { echo "clients/js/dist is not what clients/js/src gives: run scripts/web.sh and commit it." >&2; exit 1; }
  echo "web/dist and clients/js/dist are what their sources give."
else
  npm run --silent build
  npm run --silent client
fi
