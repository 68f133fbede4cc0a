#!/usr/bin/env bash
# Stress test: N random models from a seed on, each solved and checked by mechanics of its own.
#   scripts/stress.sh N [first_seed] [first|broad|laws|media|soil|members]
# SECONDS_PER_MODEL bounds the processor time of one solution (60). See docs/stress.md.
set -u
cd "$(dirname "$0")/.."
count=${1:?usage: scripts/stress.sh N [first_seed] [first|broad|laws|media|soil|members]}
first=${2:-0}
draw=${3:-broad}
bound=${SECONDS_PER_MODEL:-60}
if [ ! -f build/release/build.ninja ]; then cmake --preset release >/dev/null || exit 1; fi
ninja -C build/release stress_run >/dev/null || { echo "stress_run does not build" >&2; exit 1; }
out=$(mktemp -d)
cp build/release/tests/stress_run "$out/"  # a build during a long run does not touch it
trap 'rm -rf "$out"' EXIT

# One of two processes: every second seed; a crash costs its own seed only.
worker() {
  local from=$((first + $1)) log="$out/$1" last status
  : > "$log"
  while [ "$from" -lt $((first + count)) ]; do
    "$out/stress_run" "$draw" "$from" $((first + count - from)) 2 "$bound" >> "$log" 2>> "$out/$1.err"
    status=$?
    [ "$status" -eq 0 ] && return
    last=$(awk '/^start/ {seed = $2} END {print seed}' "$log")
    [ -n "$last" ] || { echo "fail $from crash: status $status" >> "$log"; return; }
    echo "fail $last crash: ended by status $status" >> "$log"
    from=$((last + 2))
  done
}
worker 0 & one=$!
worker 1 & two=$!
wait "$one" "$two"
cat "$out/0" "$out/1" > "$out/all"
[ -n "${STRESS_LOG:-}" ] && cp "$out/all" "$STRESS_LOG"
awk -v wanted="$count" -f scripts/stress_table.awk "$out/all"
