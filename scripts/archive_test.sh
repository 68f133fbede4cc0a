#!/usr/bin/env bash
# Tries the archive of scripts/archive.sh in a root that holds nothing but a shell, as root: solves every example, the
# requests and the sweep of tests/clients, compares with another build of the program, and runs the service with a job.
#   scripts/archive_test.sh ARCHIVE [PROGRAM]     PROGRAM: build/release/snapthrough
# BASE=FOLDER tries it in a copy of that root instead, of whatever distribution.
set -euo pipefail
archive="$(realpath "$1")"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program="$(realpath "${2:-build/release/snapthrough}")"
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
install_packages busybox-static curl jq python3
root="$(mktemp -d)"
service=""
leave() {
  if [ -n "$service" ]; then
    kill "$service" 2>/dev/null || true
    wait "$service" 2>/dev/null || true
  fi
  umount "$root/proc" 2>/dev/null || true
  umount "$root/dev" 2>/dev/null || true
  rm -rf --one-file-system "$root"
}
trap leave EXIT

if [ -n "${BASE:-}" ]; then
  cp -a "$BASE/." "$root/"
else
  mkdir "$root/bin"
  cp "$(command -v busybox)" "$root/bin/busybox"
  for name in sh readlink dirname grep; do
    ln -s busybox "$root/bin/$name"
  done
fi
mkdir -p "$root/proc" "$root/tmp" "$root/dev" "$root/examples" "$root/opt"
tar -C "$root/opt" -xzf "$archive"
inside_program="/opt/$(basename "$archive" .tar.gz)/bin/snapthrough"
cp examples/*.json "$root/examples/"
mkdir "$root/clients"
cp -r tests/clients/requests tests/clients/sweep_500.json "$root/clients/"
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
enter=(env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$root")

"${enter[@]}" "$inside_program" --version
tried=0
for file in examples/*.json; do
  # An analysis that does not reach its end is an answer, too; its status is compared.
  wanted=0
  found=0
  "$program" solve "$file" >"$root/tmp/wanted.json" 2>/dev/null || wanted=$?
  "${enter[@]}" "$inside_program" solve "$file" >"$root/tmp/found.json" 2>/dev/null || found=$?
  if [ "$found" != "$wanted" ]; then
    echo "$file: exit status $found, not $wanted" >&2
    exit 1
  fi
  if [ "$wanted" = 0 ]; then
    "$program" recompute --tolerance 1e-10 "$file" "$root/tmp/found.json" >/dev/null
  fi
  tried=$((tried + 1))
done
echo "$tried examples: as those of $program"
python3 tests/clients/native/compare_programs.py "$program" /clients "${enter[@]}" "$inside_program"

"${enter[@]}" "$inside_program" serve --listen 127.0.0.1:0 --store /tmp/store.db 2>"$root/tmp/log" &
service=$!
port=""
for _ in $(seq 100); do
  port="$(jq -R -r 'fromjson? | select(.event == "listening") | .port' "$root/tmp/log")"
  [ -z "$port" ] || break
  sleep 0.1
done
if [ -z "$port" ]; then
  echo "The service does not start:" >&2
  cat "$root/tmp/log" >&2
  exit 1
fi
curl -fsS -H 'Content-Type: application/json' -H 'Prefer: return=representation, wait=30' --data-binary @examples/column_winkler.json \
  "http://127.0.0.1:$port/v1/jobs" >"$root/tmp/job.json"
"$program" recompute --tolerance 1e-10 examples/column_winkler.json "$root/tmp/job.json" >/dev/null
echo "a job of the service: as that of $program"
