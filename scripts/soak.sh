#!/usr/bin/env bash
# Keeps the service at about 70 % of the load it can take for MINUTES (30), with retention and backups running, and
# prints jobs solved, memory, descriptors, log, WAL and store sizes once a minute; at the end a restored backup has to answer.
#   scripts/soak.sh [MINUTES]      needs a built tree (build/release)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
minutes="${1:-30}"
program=build/release/snapthrough
load=build/release/bench/bench_service_load
folder="$(mktemp -d)"
service=""
trap 'kill "$service" 2>/dev/null || true; rm -rf "$folder"' EXIT

# start STORE LOG: sets service and port.
start() {
  "$program" serve --listen 127.0.0.1:0 --store "$1" --keep-jobs-s 60 --log-level warning >/dev/null 2>"$2" &
  service=$!
  port=""
  for _ in $(seq 100); do
    port="$(ss -Hltnp 2>/dev/null | sed -n "s/.*127.0.0.1:\([0-9]*\) .*pid=$service,.*/\1/p" | head -1)"
    [ -n "$port" ] && return 0
    sleep 0.1
  done
  echo "the service does not listen" >&2
  return 1
}

report() {
  local rss files wal db log solved
  solved="$(sed -n 's/^solved \([0-9]*\) .*/\1/p' "$folder/load.log")"
  rss="$(awk '/VmRSS/ {print int($2 / 1024)}' "/proc/$service/status")"
  files="$(find "/proc/$service/fd" -mindepth 1 2>/dev/null | wc -l)"
  wal="$(stat -c %s "$folder/soak.db-wal" 2>/dev/null || echo 0)"
  db="$(stat -c %s "$folder/soak.db")"
  log="$(stat -c %s "$folder/log")"
  printf 'minute %3d: %5d jobs/s, memory %4d MB, descriptors %3d, WAL %3d MB, store %4d MB, log %6d B\n' "$1" \
    "$solved" "$rss" "$files" $((wal / 1048576)) $((db / 1048576)) "$log"
}

start "$folder/soak.db" "$folder/log"
full="$("$load" "$port" 5 8 0 | sed -n 's/^solved \([0-9]*\) .*/\1/p')"
rate=$((full * 7 / 10))
echo "the service solves $full small jobs a second; soaking at $rate for $minutes minutes"
for minute in $(seq "$minutes"); do
  "$load" "$port" 58 8 "$rate" >"$folder/load.log" || { cat "$folder/load.log"; exit 1; }
  "$program" backup --store "$folder/soak.db" "$folder/backup.db" >/dev/null
  report "$minute"
done
job="$(curl -fsS "http://127.0.0.1:$port/v1/jobs?status=successful&limit=1" | jq -r '.jobs[0].id')"
"$program" backup --store "$folder/soak.db" "$folder/backup.db"
kill "$service"
wait "$service"
start "$folder/backup.db" "$folder/log2"
curl -fsS "http://127.0.0.1:$port/v1/jobs/$job/result" | jq -c '.summary' || exit 1
echo "the restored backup answers"
