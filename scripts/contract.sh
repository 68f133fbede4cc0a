#!/usr/bin/env bash
# After a change of a field: makes what follows from api/openapi/openapi.json (types of the clients and of the page, tables of
# documents) and checks tables of fields, documents, responses, clients and page against it.
#   scripts/contract.sh [BUILD_FOLDER]     default: build/release
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build="${1:-build/release}"
cmake --build "$build" --target snapthrough snapthrough_shared pages api_tests --parallel "${JOBS:-$(nproc)}"
"$build/tests/api_tests" --gtest_brief=1
bash scripts/web.sh --check
bash scripts/schema.sh "$build/snapthrough"
