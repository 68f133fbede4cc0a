#!/usr/bin/env bash
# Writes the page with the solver inside: a folder that any file server serves, without a service.
#   scripts/site.sh FOLDER      the folder must be empty or not there
# It needs build/release/snapthrough (scripts/run.sh builds it) and builds the solver for WebAssembly where it is not.
set -euo pipefail
if [ $# -ne 1 ]; then
  echo "usage: scripts/site.sh FOLDER" >&2
  exit 1
fi
site="$(realpath -m "$1")"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=build/release/snapthrough
if [ ! -x "$program" ]; then
  echo "$program is not there: scripts/run.sh builds it." >&2
  exit 1
fi
if [ -d "$site" ] && [ -n "$(ls -A "$site")" ]; then
  echo "$site is not empty." >&2
  exit 1
fi
[ -f build/wasm/package/snapthrough.wasm ] || bash scripts/wasm.sh --build

mkdir -p "$site/v1" "$site/docs"
cp -r web/dist/. "$site/"
cp -r build/wasm/package "$site/solver"
for folder in . thesis performance gallery; do
  mkdir -p "$site/docs/$folder"
  find "docs/$folder" -maxdepth 1 \( -name '*.md' -o -name '*.svg' \) -exec cp -t "$site/docs/$folder" {} +
done
cp examples/gallery/*.json "$site/docs/gallery/"

# documents that the service makes
work="$(mktemp -d)"
"$program" serve --listen 127.0.0.1:0 --workers 1 --store "$work/store.db" 2>"$work/log" &
service=$!
trap 'kill "$service" 2>/dev/null || true; rm -rf "$work"' EXIT
address=""
while [ -z "$address" ]; do
  kill -0 "$service" 2>/dev/null || { cat "$work/log" >&2; exit 1; }
  address="$(jq -r 'select(.event == "listening") | "http://\(.host):\(.port)"' "$work/log" 2>/dev/null | head -n 1 || true)"
  sleep 0.1
done
for name in examples limits openapi; do
  path="/v1/$name"
  [ "$name" != openapi ] || path=/v1/openapi.json
  curl --silent --show-error --fail "$address$path" >"$site/v1/$name.json"
done

# addresses below any path, the solver in place of a service, and files that are kept for use without a network
sed -i -e 's|="/assets/|="assets/|g' -e 's|<a href="/v1/openapi.json">|<a href="v1/openapi.json">|' \
  -e 's|<head>|<head>\n<meta name="snapthrough-solver" content="local">|' \
  -e 's|</head>|<script type="module" src="keep.js"></script>\n</head>|' "$site/index.html"
cp clients/wasm/site/keep.js clients/wasm/site/offline.js "$site/"
(cd "$site" && find . -type f ! -name offline.js -printf '%P\n' | LC_ALL=C sort) >"$work/files"
jq -R . "$work/files" | jq -s . >"$work/files.json"
version="$(cd "$site" && xargs -d '\n' sha256sum <"$work/files" | sha256sum | cut -c 1-16)"
{
  printf 'const VERSION = "%s";\nconst FILES = ' "$version"
  cat "$work/files.json"
  cat "$site/offline.js"
} >"$work/offline.js"
mv "$work/offline.js" "$site/offline.js"
printf '%s: %s files, %s\n' "$site" "$(find "$site" -type f | wc -l)" "$(du -sh "$site" | cut -f 1)"
