#!/usr/bin/env bash
# Installs a build into an empty root, builds examples/library and examples/c against nothing but what was installed
# there, and runs them.
#   link_installed.sh BUILD_FOLDER SOURCE_FOLDER
# The load is that of thesis table 4.5 at k = 1e7, converged: 93.117814; asked for are 1e-3.
set -euo pipefail
build="$1"
source="$2"
root="$(mktemp -d)"
trap 'rm -rf "$root"' EXIT
cmake --install "$build" --prefix "$root/usr" >/dev/null
cp -r "$source/examples/library" "$root/program"  # no header of the sources is beside it
cmake -S "$root/program" -B "$root/build" -DCMAKE_PREFIX_PATH="$root/usr" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" >/dev/null
cmake --build "$root/build" >/dev/null
files="$(find "$root/usr" -name '*.cmake')"
[ -n "$files" ]
if grep -E -- '-march|mold|Werror|Eigen' $files; then
  echo "the package passes on what is this build's own"
  exit 1
fi
answer="$("$root/build/arch_in_ground")"
echo "$answer"
awk '{ error = ($1 - 93.117814) / 93.117814; exit error * error > 1e-6 }' <<<"$answer"
"$root/build/path_with_hooks" | tee "$root/path"
grep -q "points, [1-9][0-9]* critical points met, stopped" "$root/path"
awk '/^first limit load/ { error = ($4 - 93.117814) / 93.117814; found = error * error < 1e-6 } END { exit !found }' "$root/path"
"$root/usr/bin/snapthrough" --version

# The C interface: a compiler of C, pkg-config, and Python's ctypes. The same arch is examples/arch_outside_base_k1e7.json.
export PKG_CONFIG_PATH
PKG_CONFIG_PATH="$(dirname "$(find "$root/usr" -name snapthrough.pc)")"
library="$(dirname "$PKG_CONFIG_PATH")"
# shellcheck disable=SC2046
cc -std=c99 -Wall -Wextra -Wpedantic -Werror "$source/examples/c/critical_load.c" \
  $(pkg-config --define-variable=prefix="$root/usr" --cflags --libs snapthrough) -o "$root/critical_load"
export LD_LIBRARY_PATH="$library"
load="$("$root/critical_load" "$source/examples/arch_outside_base_k1e7.json" 2>/dev/null |
  python3 -c 'import json, sys; print(json.load(sys.stdin)["summary"]["critical_load_factor"])')"
echo "from C: $load"
awk '{ error = ($1 - 93.117814) / 93.117814; exit error * error > 1e-6 }' <<<"$load"
python3 "$source/examples/c/critical_load.py" libsnapthrough.so.1 "$source/examples/arch_outside_base_k1e7.json" |
  grep -F "$load limit_max"
