#!/usr/bin/env bash
# Runs examples/octave against an installed tree and compares its critical loads with those of the command line.
#   octave.sh BUILD_FOLDER SOURCE_FOLDER
set -euo pipefail
build="$1"
source="$2"
root="$(mktemp -d)"
trap 'rm -rf "$root"' EXIT
cmake --install "$build" --prefix "$root/usr" >/dev/null
export PKG_CONFIG_PATH
PKG_CONFIG_PATH="$(dirname "$(find "$root/usr" -name snapthrough.pc)")"
mkdir "$root/examples"
cp -r "$source/examples/octave" "$source/examples/column_winkler.json" "$root/examples"
cd "$root/examples/octave"
# shellcheck disable=SC2046
mkoctfile snapthrough_solve.cc $(pkg-config --define-variable=prefix="$root/usr" --cflags --libs snapthrough)
export LD_LIBRARY_PATH
LD_LIBRARY_PATH="$(dirname "$PKG_CONFIG_PATH")"
octave-cli critical_loads.m >"$root/loads"
cat "$root/loads"
while read -r stiffness load; do
  sed "s/\"stiffness\": 10/\"stiffness\": $stiffness/" ../column_winkler.json |
    "$root/usr/bin/snapthrough" solve - 2>/dev/null |
    python3 -c 'import json, sys; assert json.load(sys.stdin)["summary"]["critical_load_factor"] == float(sys.argv[1])' "$load"
done <"$root/loads"
[ "$(wc -l <"$root/loads")" -eq 3 ]
# A wrong request is an error of Octave that says what is wrong.
octave-cli --eval 'snapthrough_solve("{}")' 2>"$root/errors" && exit 1
grep -q '"pointer":"/model"' "$root/errors"
