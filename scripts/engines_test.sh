#!/usr/bin/env bash
# A sweep of 20 000 points by every engine of docs/howto/engines.md, with workers killed on the way: the rows must be
# those of the command line, byte for byte. Prints a table of times. Takes some minutes; scripts/test.sh leaves it out.
#   scripts/engines_test.sh BUILD_FOLDER [POINTS]
# Slurm runs on this machine alone, controller and worker, in a temporary folder, as root.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/lib/packages.sh
source scripts/lib/packages.sh

[ $# -ge 1 ] || { echo "usage: scripts/engines_test.sh BUILD_FOLDER [POINTS]" >&2; exit 1; }
install_packages python3 python3-distributed python3-joblib python3-mpi4py openmpi-bin slurm-wlm munge

folder="$(mktemp -d)"
daemons=()
stop_slurm() {
  if [ ${#daemons[@]} -gt 0 ]; then
    kill "${daemons[@]}" 2>/dev/null || true
    wait "${daemons[@]}" 2>/dev/null || true
  fi
  rm -rf "$folder"
}
trap stop_slurm EXIT

# Writes slurm.conf for one node of two processors without accounting, and starts munged, slurmctld and slurmd.
start_slurm() {
  local host
  host="$(hostname -s)"
  mkdir "$folder/state" "$folder/spool"
  chmod 755 "$folder"
  head -c 1024 /dev/urandom >"$folder/munge.key"
  chmod 600 "$folder/munge.key"
  cat >"$folder/slurm.conf" <<CONF
ClusterName=here
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF="$folder/slurm.conf"
  /usr/sbin/munged --force --foreground --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
    --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" --seed-file="$folder/munge.seed" \
    >"$folder/munged.out" 2>&1 &
  daemons+=($!)
  for _ in $(seq 50); do
    [ -S "$folder/munge.socket" ] && break
    sleep 0.1
  done
  slurmctld -D -f "$folder/slurm.conf" >"$folder/slurmctld.log" 2>&1 &
  daemons+=($!)
  slurmd -D -f "$folder/slurm.conf" -N "$host" >"$folder/slurmd.log" 2>&1 &
  daemons+=($!)
  for _ in $(seq 100); do
    if sinfo -h -o %T 2>/dev/null | grep -q idle; then
      return 0
    fi
    sleep 0.2
  done
  echo "Slurm did not start:" >&2
  tail -n 5 "$folder"/*.log >&2
  return 1
}

without=()
if start_slurm; then
  /usr/bin/python3 clients/python/tests/engines/page.py "$1"
else
  echo "The job array runs without Slurm, with the variables set by hand." >&2
  without=(--without slurm)
  /usr/bin/python3 clients/python/tests/engines/page.py "$1" --without-slurm
fi
/usr/bin/python3 clients/python/tests/engines/check.py "$@" "${without[@]}"
