#!/usr/bin/env bash
# Tests the tools for language models by the client of the Model Context Protocol from npm.
#   scripts/mcp_test.sh [executable]     default: build/release/snapthrough
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

SERVICE_EXECUTABLE="$(realpath "${1:-build/release/snapthrough}")"
export SERVICE_EXECUTABLE
cd tests/clients/mcp
# The lock file fixes every package by its hash.
npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
npm test --silent
