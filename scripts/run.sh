#!/usr/bin/env bash
# Builds the service, starts it, and has it analyse a real structure: an arch that presses on a one-sided base.
#   scripts/run.sh           leaves the service running in the foreground (Ctrl-C stops it)
#   scripts/run.sh --once    stops it afterwards
# Needs Debian 12, git and root (or sudo) for the packages that are missing; a second call installs and rebuilds
# nothing. PORT=n sets the port that is tried first (8080).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

build=build/release
example=examples/arch_outside_base_k1e7.json
once=no
case "${1:-}" in
  --once) once=yes ;;
  "") ;;
  *) echo "usage: scripts/run.sh [--once]" >&2; exit 1 ;;
esac

build_service() {
  mkdir -p "$build"
  if [ ! -f "$build/build.ninja" ]; then
    cmake --preset release >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; return 1; }
  fi
  # all that `cmake --install` installs; tests and benchmarks are built when they are asked for
  cmake --build "$build" --target snapthrough snapthrough_shared pages --parallel "$(nproc)"
}

port_is_taken() {
  (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null
}

# Starts the service in the background; sets `service` (process id) and `url`.
start_service() {
  local port="${PORT:-8080}" store="$build/snapthrough.db" log="$build/service.log"
  if port_is_taken "$port"; then
    echo "Port $port is taken, using a free one."
    port=0
  fi
  if [ -e "$store" ] && ! flock --nonblock "$store" true; then
    store="$build/snapthrough-$$.db"
    log="$build/service-$$.log"
    echo "Another service has the usual store, using $store."
  fi
  "$build/snapthrough" serve --listen "127.0.0.1:$port" --store "$store" 2>"$log" &
  service=$!
  trap 'kill "$service" 2>/dev/null || true' EXIT
  port=""
  for _ in $(seq 100); do
    port="$(jq -R -r 'fromjson? | select(.event == "listening") | .port' "$log")"
    if [ -n "$port" ]; then
      break
    fi
    if ! kill -0 "$service" 2>/dev/null; then
      echo "The service did not start:" >&2
      cat "$log" >&2
      return 1
    fi
    sleep 0.1
  done
  if [ -z "$port" ]; then
    echo "The service does not listen after 10 s; see $log" >&2
    return 1
  fi
  url="http://127.0.0.1:$port"
  echo "The service listens on $url (store $store, log $log)"
}

# Posts the example; sets `result_url`. The reply is the result when it is done within 10 s, else the job's status.
post_example() {
  local headers="$build/reply.headers" reply="$build/reply.json" job status
  status="$(curl -sS -o "$reply" -D "$headers" -w '%{http_code}' -H 'Content-Type: application/json' \
    --data-binary "@$example" "$url/v1/jobs")"
  if [ "$status" != 200 ] && [ "$status" != 201 ]; then
    echo "The service answered with status $status:" >&2
    jq . "$reply" >&2
    return 1
  fi
  job="$(tr -d '\r' <"$headers" | sed -n 's/^[Ll]ocation: //p')"
  result_url="$url$job/result"
  while [ "$(curl -sS -H 'Prefer: wait=60' "$url$job" | jq -r '.progress')" != 100 ]; do
    echo "Still computing ..."
  done
}

print_result() {
  local result="$build/result.json"
  curl -sS --fail-with-body -o "$result" "$result_url" || { jq . "$result" >&2; return 1; }
  echo
  echo "Example         $example"
  jq -r '"Critical load   " + (.summary.critical_load_factor | if . == null then "none" else (. * 1e6 | round) / 1e6 | tostring end),
         "Kind            " + (.summary.critical_type | tostring),
         "Run time        " + ((.diagnostics.wall_time_s * 1e4 | round) / 10 | tostring) + " ms"' "$result"
  echo "Stored result   $result_url"
  echo "Page            $url"
  echo
}

stop_service() {
  kill "$service" 2>/dev/null || true
  wait "$service" || { echo "The service did not stop cleanly." >&2; return 1; }
}

install_packages "${BUILD_PACKAGES[@]}" "${RUN_PACKAGES[@]}"
build_service
start_service
post_example
print_result
if [ "$once" = yes ]; then
  stop_service
  trap - EXIT
  exit 0
fi
echo "Ctrl-C stops the service."
trap stop_service EXIT
trap 'exit 0' INT TERM
wait "$service"
