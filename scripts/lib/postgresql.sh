#!/usr/bin/env bash
# A server of PostgreSQL in a folder of its own, for tests and benchmarks: it listens to a socket in that folder only.
#   scripts/lib/postgresql.sh start FOLDER [SETTING=VALUE...]   as an unprivileged user; ends when the caller ends
#   scripts/lib/postgresql.sh stop FOLDER                       at once, and removes the folder
#   scripts/lib/postgresql.sh location FOLDER                   what --store takes
# LIFE=PID: it ends with that process instead; LIFE=own: it goes on.
set -euo pipefail

command="$1"
folder="$2"
self="$(realpath "${BASH_SOURCE[0]}")"
bin="$(ls -d /usr/lib/postgresql/*/bin 2>/dev/null | sort -V | tail -1)"
if [ -z "$bin" ]; then
  echo "PostgreSQL is not installed: scripts/test.sh installs it" >&2
  exit 1
fi

# PostgreSQL refuses to run as root.
unprivileged() {
  if [ "$(id -u)" -eq 0 ]; then
    setpriv --reuid=nobody --regid=nogroup --clear-groups "$@"
  else
    "$@"
  fi
}

stop() {
  if [ -f "$folder/data/postmaster.pid" ]; then
    unprivileged "$bin/pg_ctl" -D "$folder/data" -m immediate -w stop >/dev/null 2>&1 || true
  fi
  rm -rf "$folder"
}

start() {
  stop
  mkdir -p "$folder"
  if [ "$(id -u)" -eq 0 ]; then
    chown nobody:nogroup "$folder"
  fi
  cd "$folder"
  unprivileged "$bin/initdb" -D "$folder/data" -U snapthrough -A trust -E UTF8 --locale=C --no-sync >"$folder/initdb.log"
  local options="-c listen_addresses= -c unix_socket_directories=$folder -c max_connections=200 -c fsync=off" setting
  for setting in "$@"; do
    options+=" -c $setting"
  done
  unprivileged "$bin/pg_ctl" -D "$folder/data" -w -l "$folder/server.log" -o "$options" start >/dev/null
  unprivileged "$bin/createdb" -h "$folder" -U snapthrough snapthrough
  if [ "${LIFE:-}" != own ]; then
    echo "$$" >"$folder/start" # by which the watcher knows its server: a later one may have the same folder
    setsid bash -c 'while kill -0 "$1" 2>/dev/null; do sleep 1; done
      [ "$(cat "$3/start")" != "$4" ] || exec bash "$2" stop "$3"' \
      watch "${LIFE:-$PPID}" "$self" "$folder" "$$" </dev/null >/dev/null 2>&1 &
  fi
}

case "$command" in
  start) start "${@:3}" ;;
  stop) stop ;;
  location) echo "postgresql://snapthrough@/snapthrough?host=$folder" ;;
  *) echo "start, stop or location, not $command" >&2; exit 2 ;;
esac
