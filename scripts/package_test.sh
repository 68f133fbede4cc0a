#!/usr/bin/env bash
# Installs, uses, upgrades, removes and purges the Debian package in a bare Debian 12, and looks after each step at what is there.
#   scripts/package_test.sh [PACKAGE.deb]      the package: build/package/packages/snapthrough_*.deb, from scripts/package.sh
# The libraries beside it are installed and used, too.
# BEFORE=PROGRAM is the executable of an earlier version: the store that it wrote is upgraded, its schema too. Without it the
# package before has the same program under a lower version. It needs root. Where systemd-nspawn can boot a system the unit
# is run by systemd; elsewhere (or with BY_HAND=1) its ExecStart line is run as its user.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh
install_packages debootstrap systemd-container dpkg-dev util-linux iproute2 sqlite3 gcc libc6-dev pkg-config

package="${1:-$(ls build/package/packages/snapthrough_*.deb)}"
work="$(mktemp -d)"
root="$work/root"
base=build/package/base.tar
leader=""
unit=/lib/systemd/system/snapthrough.service

say() { echo "== $*" >&2; }
fail() { echo "package_test: $*" >&2; exit 1; }

finish() {
  if [ -n "$leader" ]; then
    kill -KILL "$leader" 2>/dev/null || true
  fi
  for _ in $(seq 50); do
    rm -rf --one-file-system "$work" 2>/dev/null && break
    sleep 0.2
  done
}
trap finish EXIT

# The bare system, from where this machine's apt has its packages.
make_base() {
  local mirror
  # shellcheck disable=SC2016
  mirror="$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' | head -n 1)"
  [ -n "$mirror" ] || fail "apt knows no archive of Debian 12 (bookworm)"
  say "a bare Debian 12 is made (debootstrap), and kept for the next time"
  mkdir -p "$root"
  debootstrap --variant=minbase bookworm "$root" "$mirror" >"$work/debootstrap.log" 2>&1 ||
    { cat "$work/debootstrap.log" >&2; fail "no bare system"; }
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  apt_get chroot "$root" update -qq
  apt_get chroot "$root" install -y -qq --no-install-recommends systemd systemd-sysv dbus >"$work/debootstrap.log" 2>&1
  mkdir -p "$(dirname "$base")"
  tar -C "$root" -cf "$base.part" . && mv "$base.part" "$base"
}

# apt_get COMMAND... SUBCOMMAND...: apt-get run by COMMAND (chroot ROOT, or inside).
apt_get() {
  local by=("$1")
  shift
  if [ "${by[0]}" = chroot ]; then
    by+=("$1")
    shift
  fi
  "${by[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 apt-get -o Dpkg::Use-Pty=0 "$@"
}

# start_system: boots the root with a network of its own, so that ports of this machine do not matter.
start_system() {
  systemd-nspawn --quiet --register=no --keep-unit --private-network --boot --directory "$root" \
    --console=read-only >"$work/boot.log" 2>&1 </dev/null &
  local nspawn=$!
  for _ in $(seq 150); do
    leader="$(pgrep -P "$nspawn" | head -n 1 || true)"
    if [ -n "$leader" ] && [ "$(inside systemctl is-system-running 2>/dev/null)" = running ]; then
      return 0
    fi
    kill -0 "$nspawn" 2>/dev/null || break
    sleep 0.2
  done
  kill -KILL "$nspawn" ${leader:+"$leader"} 2>/dev/null || true
  leader=""
  return 1
}

# start_holder: without systemd, a network and processes of its own that commands are run in.
start_holder() {
  unshare --net --mount --pid --fork --mount-proc="$root/proc" sleep infinity &
  local holder=$!
  for _ in $(seq 50); do
    leader="$(pgrep -P "$holder" | head -n 1 || true)"
    [ -z "$leader" ] || break
    sleep 0.1
  done
  [ -n "$leader" ] || fail "no namespaces"
  nsenter --net --target "$leader" ip link set lo up
}

inside() {
  if [ -n "$booted" ]; then
    nsenter --all --target "$leader" "$@"
  else
    nsenter --net --mount --pid --target "$leader" chroot "$root" "$@"
  fi
}

# service_up: waits until the service takes work; by hand it starts it, as its unit says.
service_up() {
  if [ -z "$booted" ] && ! inside snapthrough health 127.0.0.1:8080 2>/dev/null; then
    local line
    line="$(sed -n 's/^ExecStart=//p' "$root$unit")"
    inside sh -c "cd /var/lib/snapthrough && exec setpriv --reuid snapthrough --regid snapthrough --clear-groups \
      --no-new-privs --bounding-set=-all $line" >"$work/service.log" 2>&1 &
  fi
  for _ in $(seq 100); do
    inside snapthrough health 127.0.0.1:8080 --ready 2>/dev/null && return 0
    sleep 0.1
  done
  [ -z "$booted" ] || inside journalctl --no-pager -u snapthrough | tail -n 20 >&2
  fail "the service does not take work"
}

# The process of the service, as the system inside numbers it; nothing when there is none.
service_pid() {
  # shellcheck disable=SC2016
  inside sh -c 'for process in /proc/[0-9]*; do
      case "$(tr "\\0" " " 2>/dev/null <"$process/cmdline")" in
        "/usr/bin/snapthrough serve "*) echo "${process#/proc/}" ;;
      esac
    done' 2>/dev/null | head -n 1
}

# stop_by_hand: what systemd does by itself.
stop_by_hand() {
  local pid
  pid="$(service_pid)"
  if [ -z "$booted" ] && [ -n "$pid" ]; then
    inside sh -c "kill -TERM $pid"
    for _ in $(seq 100); do
      [ -n "$(service_pid)" ] || return 0
      sleep 0.1
    done
    fail "the service does not stop"
  fi
}

schema_step() { sqlite3 "file:$root/var/lib/snapthrough/jobs.db?mode=ro" 'SELECT max(version) FROM schema_migrations'; }

# pack_before: the package before, under a lower version.
pack_before() {
  dpkg-deb --raw-extract "$package" "$work/before"
  sed -i 's/^Version: .*/Version: 0.0.1-1/' "$work/before/DEBIAN/control"
  if [ -n "${BEFORE:-}" ]; then
    install -m 755 "$BEFORE" "$work/before/usr/bin/snapthrough"
    sed -i '\| usr/bin/snapthrough$|d' "$work/before/DEBIAN/md5sums"
  fi
  dpkg-deb --build --root-owner-group "$work/before" "$root/root/before.deb" >/dev/null
  cp "$package" "$root/root/after.deb"
  # Asks the service, whatever version that is.
  dpkg-deb --fsys-tarfile "$package" | tar -xO ./usr/bin/snapthrough >"$root/root/client"
  chmod 755 "$root/root/client"
}

install_it() {
  local shown
  shown="$(apt_get inside install -y "/root/$1.deb" 2>&1)" || { echo "$shown" >&2; fail "apt-get install of $1"; }
  ! grep -iE '^(warning|error)|dpkg: warning' <<<"$shown" || fail "apt-get or dpkg warned"
}

check_is_installed() {
  service_up
  local pid user
  pid="$(service_pid)"
  user="$(inside stat -c %U "/proc/$pid")"
  [ "$user" = snapthrough ] || fail "the service runs as $user"
  [ "$(inside stat -c '%U %a' /var/lib/snapthrough)" = "snapthrough 700" ] || fail "/var/lib/snapthrough is open"
  if [ -n "$booted" ]; then
    [ "$(inside systemctl is-enabled snapthrough)" = enabled ] || fail "the unit is not enabled"
    [ "$(inside systemctl --failed --no-legend | wc -l)" = 0 ] || fail "a unit failed"
  fi
}

# filters PROCESS: how many filters of system calls the kernel applies to it.
filters() { inside sed -n 's/^Seccomp_filters:[^0-9]*//p' "/proc/$1/status"; }

# The unit's filter does not keep processes that compute from applying their own.
check_runners_are_confined() {
  local pid runner
  pid="$(service_pid)"
  runner="$(inside sh -c "cat /proc/$pid/task/*/children" | tr ' ' '\n' | grep -m 1 .)" || fail "there is no runner"
  [ "$(filters "$runner")" -gt "$(filters "$pid")" ] || fail "the runner has no filter of its own"
}

# add_key NAME: a key in /root/NAME, and its digest in the configuration.
add_key() {
  local key
  key="$(head -c 32 /dev/urandom | sha256sum | cut -d ' ' -f 1)"
  echo "$key" >"$root/root/$1"
  printf '[[keys]]\nowner = "%s"\nsha256 = "%s"\n' "$1" "$(printf %s "$key" | sha256sum | cut -d ' ' -f 1)" \
    >>"$root/etc/snapthrough/config.toml"
}

# Whether keys are asked for is decided at the start; others are read by a reload, without a restart.
check_keys_are_read() {
  local pid
  add_key ann
  inside systemctl restart snapthrough
  service_up
  pid="$(service_pid)"
  ! inside snapthrough submit "$example" >"$work/refused" 2>&1 || fail "a key is not asked for"
  grep -q unauthorized "$work/refused" || fail "refused otherwise: $(cat "$work/refused")"
  inside snapthrough submit "$example" --key-file /root/ann >/dev/null || fail "the first key is not taken"
  add_key ben
  inside systemctl reload snapthrough
  for _ in $(seq 50); do
    inside snapthrough submit "$example" --key-file /root/ben >/dev/null 2>&1 && break
    sleep 0.1
  done
  inside snapthrough submit "$example" --key-file /root/ben >/dev/null || fail "the second key is not taken"
  [ "$(service_pid)" = "$pid" ] || fail "the service was restarted for a second key"
}

check_is_purged() {
  local left
  left="$(find "$root" -xdev \( -iname '*snapthrough*' -o -iname '*snapthrough*' -type l \) \
    -not -path "$root/proc/*" -not -path "$root/tmp/*" -not -path "$root/root/*")"
  [ -z "$left" ] || fail "left after purge: $left"
  ! grep -q snapthrough "$root/etc/passwd" "$root/etc/group" || fail "the user is left"
  ! inside dpkg-query -W snapthrough 2>/dev/null | grep . || fail "dpkg knows the package"
  [ -z "$(service_pid)" ] || fail "the service runs"
}

[ -f "$base" ] || make_base
if [ ! -d "$root" ]; then
  mkdir -p "$root"
  tar -C "$root" -xf "$base"
fi
pack_before
libraries=()
for file in "$(dirname "$package")"/{libsnapthrough,python3-snapthrough}*.deb; do
  if [ -f "$file" ]; then
    cp "$file" "$root/root/"
    libraries+=("/root/$(basename "$file")")
  fi
done
say "dependencies are downloaded: the system itself has no network"
apt_get chroot "$root" update -qq
apt_get chroot "$root" install -y -qq --download-only /root/before.deb >/dev/null
if [ "${#libraries[@]}" -gt 0 ]; then
  apt_get chroot "$root" install -y -qq --download-only --no-install-recommends "${libraries[@]}" >/dev/null
fi
booted=yes
if [ -n "${BY_HAND:-}" ] || ! start_system; then
  say "no systemd: the unit's ExecStart line is run by hand"
  booted=""
  start_holder
fi

say "install"
install_it before
check_is_installed
inside test -x /usr/bin/snapthrough
example=/usr/share/doc/snapthrough/examples/arch_no_base.json
job="$(inside /root/client submit "$example")"
[ "$(inside /root/client wait "$job")" = successful ] || fail "the job is not successful"
inside /root/client fetch "$job" >"$work/result_before"
grep -q critical_load_factor "$work/result_before"
step_before="$(schema_step)"
pid_before="$(service_pid)"
inside sh -c 'echo "keep_jobs_s = 777600 # by the administrator" | cat - /etc/snapthrough/config.toml >/root/config && cp /root/config /etc/snapthrough/config.toml'
cp "$root/etc/snapthrough/config.toml" "$work/config_before"

say "upgrade"
stop_by_hand
install_it after
check_is_installed
# shellcheck disable=SC2016
[ "$(inside dpkg-query -W -f '${Version}' snapthrough)" != 0.0.1-1 ] || fail "it was not upgraded"
[ "$(service_pid)" != "$pid_before" ] || fail "the service was not restarted"
inside /root/client fetch "$job" >"$work/result_after"
cmp "$work/result_before" "$work/result_after" || fail "the job's result is another one"
cmp "$work/config_before" "$root/etc/snapthrough/config.toml" || fail "the configuration is another one"
say "schema step $step_before before, $(schema_step) now"
if [ -n "${BEFORE:-}" ]; then
  [ "$(schema_step)" -gt "$step_before" ] || fail "the schema was not brought up to date"
fi
second="$(inside snapthrough submit "$example" --label after)"
[ "$(inside snapthrough wait "$second")" = successful ]
say "the commands of docs/howto/install-the-package.md"
# shellcheck disable=SC2016
{ echo "set -eu; cd /root"; sed -n '/^```sh$/,/^```$/p' docs/howto/install-the-package.md | grep -v '^```'; } >"$root/root/page.sh"
[ "$(inside sh /root/page.sh)" = successful ] || fail "the page's commands"
[ "$(head -c 6 "$root/root/path.csv")" = branch ] || fail "the page's table"
inside sh -c 'test -s /usr/share/man/man1/snapthrough-serve.1.gz && test -s /usr/share/bash-completion/completions/snapthrough'

say "remove, install again"
stop_by_hand
apt_get inside remove -y snapthrough >/dev/null 2>&1
[ -z "$(service_pid)" ] || fail "the service runs after remove"
[ -s "$root/var/lib/snapthrough/jobs.db" ] || fail "remove took the store"
cmp "$work/config_before" "$root/etc/snapthrough/config.toml" || fail "remove changed the configuration"
install_it after
check_is_installed
inside /root/client fetch "$job" | cmp - "$work/result_before"

if [ "${#libraries[@]}" -gt 0 ]; then
  say "the libraries: a program in C is compiled with what they have, and run"
  apt_get inside install -y --no-install-recommends "${libraries[@]}" >/dev/null 2>&1 || fail "apt-get install of ${libraries[*]}"
  export PKG_CONFIG_SYSROOT_DIR="$root" PKG_CONFIG_PATH
  PKG_CONFIG_PATH="$(dirname "$(find "$root/usr/lib" -name snapthrough.pc)")"
  # shellcheck disable=SC2046
  cc -std=c99 examples/c/critical_load.c $(pkg-config --cflags --libs snapthrough) -o "$root/root/critical_load"
  inside /root/critical_load "$example" >"$work/library_result" 2>/dev/null
  grep -q critical_load_factor "$work/library_result" || fail "the library does not solve"
  say "the Python package solves with the library"
  inside python3 -c 'import snapthrough as st, sys; print(st.solve(open(sys.argv[1]).read()).summary.critical_load_factor)' \
    "$example" >"$work/python_result"
  grep -qF "$(cat "$work/python_result")" "$work/library_result" || fail "Python's critical load is not the library's"
  apt_get inside purge -y libsnapthrough1 libsnapthrough-dev python3-snapthrough >/dev/null 2>&1
fi

if [ -n "$booted" ]; then
  say "runners are confined; keys are read"
  check_runners_are_confined
  check_keys_are_read
  say "systemd-analyze security"
  inside systemd-analyze security --no-pager snapthrough.service >"$work/security"
  tail -n 1 "$work/security"
  awk '/Overall exposure level/ { for (i = 1; i <= NF; ++i) if ($i ~ /^[0-9.]+$/) found = $i } END { exit !(found != "" && found < 2.0) }' \
    "$work/security" || fail "the unit is exposed more than 2.0"
fi

say "purge"
stop_by_hand
apt_get inside purge -y snapthrough >/dev/null 2>&1
check_is_purged
echo "The package installs, solves, upgrades, is removed and purged${booted:+, under systemd}."
