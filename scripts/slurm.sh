#!/usr/bin/env bash
# Submits slipface to Slurm and prints the number of the last job, for which `sbatch --wait` or a dependency can wait.
#
#   scripts/slurm.sh shards N OUT audit LEVEL --walkers 10000 ...     N array tasks, then a job that merges their reports
#   scripts/slurm.sh shards N OUT snapshot check ...                  the same; OUT is a folder that all nodes see
#   scripts/slurm.sh shards N OUT nightly PROJECT.json
#   scripts/slurm.sh mpi RANKS OUT reach LEVEL --rounds 4000 ...      one MPI job; a checkpoint lies in OUT
#   scripts/slurm.sh mpi RANKS OUT audit LEVEL ...
#
# SLIPFACE and SLIPFACE_MPI name the programs, SBATCH_ARGS more options for sbatch ("--partition=night --time=60"). The folder
# of the call is that of the jobs.
set -euo pipefail
[ $# -ge 4 ] || { sed -n '2,11s/^# \{0,1\}//p' "$0"; exit 64; }
mode=$1 count=$2 out=$3
shift 3
slipface=${SLIPFACE:-slipface} slipface_mpi=${SLIPFACE_MPI:-slipface-mpi}
read -ra more <<<"${SBATCH_ARGS:-}"
mkdir -p "$out"
words=$(printf '%q ' "$@")
submit() { sbatch --parsable --requeue --chdir="$PWD" "${more[@]}" "$@"; }

case $mode in
shards)
    # A report per shard: a file of an audit, the report.json in a folder of the others.
    part="$out/part-\$SLURM_ARRAY_TASK_ID" report=/report.json verb=$1
    [ "$verb" != audit ] || part+=.json report=
    # 1 means that the check found something, which is a good shard; everything else is a lost one. Slurm starts the shards of
    # a lost node again.
    array=$(submit --array="1-$count" --job-name="slipface $verb" --output="$out/part-%a.log" \
        --wrap "$slipface $words --shard \$SLURM_ARRAY_TASK_ID/$count --out \"$part\" || [ \$? -eq 1 ]")
    parts=$(for ((i = 1; i <= count; i++)); do printf '%q ' "$out/part-$i$([ "$verb" != audit ] || echo .json)$report"; done)
    whole="$out/whole"
    [ "$verb" != audit ] || whole+=.json
    # afterany, not afterok: merging names the shards that are missing.
    submit --dependency="afterany:$array" --job-name="slipface $verb merge" --output="$out/merge.log" \
        --wrap "$slipface $verb merge $parts --out $(printf %q "$whole")"
    ;;
mpi)
    # When a rank dies srun ends all of them, and the job is queued again, at most five times. It goes on from its checkpoint.
    checkpoint=
    [ "$1" != reach ] || checkpoint="--checkpoint $(printf %q "$out/checkpoint")"
    submit --ntasks="$count" --job-name="slipface-mpi $1" --output="$out/mpi.log" --open-mode=append --wrap "
        srun --mpi=pmix --kill-on-bad-exit=1 $slipface_mpi $words $checkpoint
        code=\$?
        if [ \$code -gt 2 ] && [ \$code -ne 64 ] && [ \"\${SLURM_RESTART_COUNT:-0}\" -lt 5 ]; then
            scontrol requeue \$SLURM_JOB_ID
        fi
        exit \$code"
    ;;
*) echo "scripts/slurm.sh: found $mode, expected shards or mpi" >&2; exit 64 ;;
esac
