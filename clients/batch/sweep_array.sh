#!/usr/bin/env bash
# One part of a sweep, as a task of a job array:
#   sbatch --array=1-16 sweep_array.sh sweep.json rows 16      Slurm; then: snapthrough merge rows.* > table.json
#   sweep_array.sh sweep.json rows 16 --loop                   no batch system: all parts, one after the other
# Part I of 16 goes to the file rows.I. A task that died is run again by the same command, or alone with --array=I:
# rows that its file has are not computed again, and a part that is complete ends at once. `merge` names parts and rows
# that are missing. Tasks of PBS, Grid Engine, LSF and of indexed jobs of Kubernetes are known, too.
# Exit status 0: every point of the part has its row, some perhaps with an error.
#SBATCH --job-name=snapthrough
#SBATCH --cpus-per-task=1
#SBATCH --requeue
set -euo pipefail

usage() {
  echo "usage: sweep_array.sh SWEEP ROWS PARTS [--loop]" >&2
  exit 1
}

# run_part I: computes part I; rows with an error (status 3) are rows.
run_part() {
  local status=0
  snapthrough sweep "$sweep" --part "$1/$parts" --out "$rows.$1" --threads "$threads" || status=$?
  [ "$status" -eq 3 ] || return "$status"
}

[ $# -ge 3 ] || usage
sweep=$1 rows=$2 parts=$3
threads="${SLURM_CPUS_PER_TASK:-1}"
task="${SLURM_ARRAY_TASK_ID:-${PBS_ARRAY_INDEX:-${SGE_TASK_ID:-${LSB_JOBINDEX:-}}}}"
if [ -z "$task" ] && [ -n "${JOB_COMPLETION_INDEX:-}" ]; then
  task=$((JOB_COMPLETION_INDEX + 1))
fi
if [ "${4:-}" = --loop ]; then
  for ((part = 1; part <= parts; part++)); do
    run_part "$part"
  done
elif [ -n "$task" ]; then
  run_part "$task"
else
  echo "sweep_array.sh: no variable of a batch system names the part; --loop computes all" >&2
  usage
fi
