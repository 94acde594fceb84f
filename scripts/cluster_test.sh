#!/usr/bin/env bash
# Audits, snapshot checks and searches as a cluster runs them: a slurmctld with three slurmd on this machine, a node that dies,
# an MPI rank that is killed, and what must be refused. Compares bytes with those of one process. As root; installs Open MPI and
# Slurm. The cluster lives in a network of its own that leads nowhere, and each node in processes of its own, so that
# killing a node's slurmd takes with it all that runs there.
#
#   scripts/cluster_test.sh            # about ten minutes on two cores
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/common.sh
if [ -z "${SLIPFACE_CLUSTER:-}" ]; then
    install_packages libopenmpi-dev openmpi-bin slurm-wlm munge iproute2
    configure release
    cmake -DSLIPFACE_MPI=ON build/release >/dev/null
    build release slipface slipface_mpi
    exec env SLIPFACE_CLUSTER="$(mktemp -d -p /var/tmp)" unshare --net --mount --pid --fork --mount-proc "$0" "$@"
fi

dir=$SLIPFACE_CLUSTER
bin=$PWD/build/release/editor
export SLIPFACE=$bin/slipface SLIPFACE_MPI=$bin/slipface-mpi SLURM_CONF=$dir/slurm.conf
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl=self,vader,tcp
export OMPI_MCA_btl_tcp_if_include=wire0
export OMPI_MCA_oob_tcp_if_include=lo OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_hwloc_base_binding_policy=none
trap 'rm -rf "$dir"' EXIT  # all processes of the test end with this one: it is the first of their namespace
failed=0
good() { printf '  ok    %s\n' "$*"; }
bad() { printf '  BAD   %s\n' "$*"; failed=1; }
same() { if cmp -s "$2" "$3"; then good "$1: the same $(stat -c %s "$2") bytes"; else bad "$1: $2 and $3 differ"; fi; }
# refuses CODE WORDS COMMAND...: exits with the code and says the words.
refuses() {
    local expected=$1 words=$2 code=0 text
    shift 2
    text=$("$@" 2>&1 >/dev/null) || code=$?
    text=$(grep '^slipface' <<<"$text" | head -1) || true
    if [ $code -eq "$expected" ] && [[ $text == *"$words"* ]]; then good "refused: $text"; else bad "exit $code: $text"; fi
}
wait_for() { # wait_for SECONDS COMMAND...
    local left=$(($1 * 5))
    shift
    until "$@"; do
        left=$((left - 1))
        [ $left -gt 0 ] || return 1
        sleep 0.2
    done
}

say "Starting the cluster"
ip link set lo up
# Names are looked up, and ranks of several nodes meet, only where there is an address beside the loopback's. Both ends of this
# wire are here.
ip link add wire0 type veth peer name wire1
ip addr add 10.77.0.1/24 dev wire0
ip link set wire0 up
ip link set wire1 up
mkdir -p "$dir"/{munge,state,out}
chmod 700 "$dir/munge"
head -c 1024 /dev/urandom >"$dir/munge/key"
chmod 600 "$dir/munge/key"
munged --force --key-file="$dir/munge/key" --socket="$dir/munge/socket" --pid-file="$dir/munge/pid" \
    --log-file="$dir/munge/log" --seed-file="$dir/munge/seed" 2>/dev/null
cat >"$SLURM_CONF" <<CONF
ClusterName=slipface
SlurmctldHost=$(hostname)(127.0.0.1)
AuthInfo=socket=$dir/munge/socket
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool-%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/%n.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SwitchType=switch/none
SlurmdTimeout=10
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_min_interval=1
NodeName=n[1-3] NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=[17001-17003] CPUs=2 State=UNKNOWN
PartitionName=night Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld -c
start_node() {
    mkdir -p "$dir/spool-$1"
    # Machines do not share /tmp, and two steps of one MPI job would meet there.
    unshare --pid --fork --kill-child --mount-proc bash -c \
        'mount -t tmpfs tmpfs /tmp && exec slurmd -D -N "$0" -c' "$1" >>"$dir/$1.out" 2>&1 &
    nodes[$1]=$!
    disown $! # the shell need not say that it was killed
}
declare -A nodes
for node in n1 n2 n3; do start_node $node; done
all_idle() { [ "$(sinfo --noheader --states=idle --format=%D 2>/dev/null)" = 3 ]; }
wait_for 60 all_idle || { tail "$dir/slurmctld.log"; exit 1; }
sinfo

ended() { [[ $(squeue --noheader --states=all --jobs="$1" --format=%T 2>/dev/null) =~ ^(COMPLETED|FAILED|CANCELLED|NODE_FAIL|TIMEOUT|)$ ]]; }
running_on() { squeue --noheader --states=running --nodelist="$1" --format=%i | grep -q .; }
restarts() { scontrol show job "$1" 2>/dev/null | grep -o 'Restarts=[0-9]*' | sort -u | tr '\n' ' '; }

level=assets/levels/easy.obj
audit=(audit $level --walkers 48 --seconds 400 --seed 5 --heat)
short=(audit $level --walkers 48 --seconds 40 --seed 5 --heat)
search=(reach assets/levels/island.obj --rounds 40)

say "What one process makes of it"
"$SLIPFACE" "${audit[@]}" --out "$dir/out/audit.json" >/dev/null || [ $? -eq 1 ]
"$SLIPFACE" "${search[@]}" --out "$dir/out/reach" | grep -E 'steps|cells|hash'
"$SLIPFACE" snapshot check --only 'hacks/*' --quiet --out "$dir/out/snapshots" | tail -1

say "Slurm: an audit in six shards, and a node that dies"
job=$(scripts/slurm.sh shards 6 "$dir/out/audit" "${audit[@]}")
wait_for 60 running_on n2 || bad "nothing ran on n2"
sleep 1
kill -9 "${nodes[n2]}" # unshare, which takes its slurmd and all of the node with it
echo "killed n2 with $(squeue --noheader --states=running --nodelist=n2 --format=%i | tr '\n' ' ')"
wait_for 400 ended "$job" || bad "job $job did not end"
grep -h -E 'not responding|requeue|Requeu' "$dir/slurmctld.log" | tail -3 | sed 's/^/    /'
same "audit, merged" "$dir/out/audit.json" "$dir/out/audit/whole.json"
start_node n2
wait_for 60 all_idle || bad "n2 did not come back"

say "A shard that is lost is named"
rm "$dir/out/audit/part-3.json"
refuses 2 "1 of 6 parts missing: 3/6" "$SLIPFACE" audit merge "$dir"/out/audit/part-*.json

say "Slurm: images in four shards"
job=$(scripts/slurm.sh shards 4 "$dir/out/snapshots-parts" snapshot check --only 'hacks/*' --quiet --jobs 1)
wait_for 400 ended "$job" || bad "job $job did not end"
# Times differ between two runs on one machine, too.
for part in snapshots snapshots-parts/whole; do
    python3 - "$dir/out/$part/report.json" >"$dir/out/$(basename "$part").txt" <<'PYTHON'
import json, sys
report = json.load(open(sys.argv[1]))
for entry in report["entries"]:
    del entry["seconds"], entry["drawing_s"]
print(json.dumps([report["suite"], report["entries"]], indent=1))
PYTHON
done
same "snapshots, merged, but for times" "$dir/out/snapshots.txt" "$dir/out/whole.txt"

say "MPI: 1, 2, 3 and 4 ranks"
for ranks in 1 2 3 4; do
    mpirun -n $ranks "$SLIPFACE_MPI" "${short[@]}" --out "$dir/out/audit-$ranks" >/dev/null || [ $? -eq 1 ]
    mpirun -n $ranks "$SLIPFACE_MPI" "${search[@]}" --threads $((1 + ranks % 2)) --out "$dir/out/reach-$ranks" >/dev/null
    same "reach on $ranks" "$dir/out/reach" "$dir/out/reach-$ranks"
done
"$SLIPFACE" "${short[@]}" --out "$dir/out/audit-0" >/dev/null || [ $? -eq 1 ]
for ranks in 1 2 3 4; do same "audit on $ranks" "$dir/out/audit-0" "$dir/out/audit-$ranks"; done

say "MPI: a rank that is killed"
checkpointed=(mpirun -n 3 "$SLIPFACE_MPI" "${search[@]}" --checkpoint "$dir/out/checkpoint" --every 4)
"${checkpointed[@]}" >"$dir/out/killed.log" 2>&1 &
job=$!
wait_for 100 test -s "$dir/out/checkpoint" || bad "no checkpoint"
victim=$(pgrep -f "slipface-mpi reach.*$dir/out/checkpoint" | tail -1)
kill -9 "$victim"
wait $job && bad "mpirun did not notice" || echo "killed rank process $victim; mpirun: exit $?"
code=0
"${checkpointed[@]}" --out "$dir/out/reach-again" | grep steps || code=$?
same "reach, gone on" "$dir/out/reach" "$dir/out/reach-again"

say "Slurm and MPI: a node that dies under a search"
job=$(scripts/slurm.sh mpi 3 "$dir/out/mpi" "${search[@]}" --every 4 --out "$dir/out/mpi-reach")
wait_for 100 test -s "$dir/out/mpi/checkpoint" || { bad "no checkpoint"; cat "$dir/out/mpi/mpi.log"; }
node=$(scontrol show job "$job" | grep -o ' NodeList=n[0-9]' | grep -o 'n[0-9]' || echo n1)
kill -9 "${nodes[$node]}"
echo "killed $node"
wait_for 400 ended "$job" || bad "job $job did not end"
echo "    $(restarts "$job")"
same "reach under Slurm, gone on" "$dir/out/reach" "$dir/out/mpi-reach"

say "What must be refused, and loses nothing"
two=(mpirun -n 1 "$SLIPFACE_MPI" audit $level --walkers 4 --seconds 1 : -n 1)
refuses 2 "has another geometry than rank 0" "${two[@]}" "$SLIPFACE_MPI" audit assets/levels/hard.obj --walkers 4 --seconds 1
refuses 2 "has another level file, settings or start" "${two[@]}" "$SLIPFACE_MPI" audit $level --walkers 4 --seconds 1 --set gravity=9
refuses 2 "has another command line" "${two[@]}" "$SLIPFACE_MPI" audit $level --walkers 5 --seconds 1
refuses 2 "no such file (rank 1 on" "${two[@]}" "$SLIPFACE_MPI" audit gone.obj --walkers 4 --seconds 1
cp "$SLIPFACE_MPI" "$dir/out/other-program"
printf x >>"$dir/out/other-program"
refuses 2 "has another program than rank 0" "${two[@]}" "$dir/out/other-program" audit $level --walkers 4 --seconds 1
cp "$dir/out/checkpoint" "$dir/out/before"
refuses 2 "found a search of another level" mpirun -n 2 "$SLIPFACE_MPI" reach $level --rounds 4 --checkpoint "$dir/out/checkpoint"
refuses 2 "expected --seed 2" mpirun -n 2 "$SLIPFACE_MPI" "${search[@]}" --seed 2 --checkpoint "$dir/out/checkpoint"
same "the checkpoint" "$dir/out/before" "$dir/out/checkpoint"
head -c 5000 "$dir/out/before" >"$dir/out/truncated"
refuses 2 "truncated" mpirun -n 2 "$SLIPFACE_MPI" "${search[@]}" --checkpoint "$dir/out/truncated"
mkdir "$dir/full"
mount -t tmpfs -o size=64k tmpfs "$dir/full"
refuses 2 "No space left" mpirun -n 2 "$SLIPFACE_MPI" "${search[@]}" --resume "$dir/out/before" --out "$dir/full/reach"
code=0
mpirun -n 2 "$SLIPFACE_MPI" "${search[@]}" --checkpoint "$dir/full/checkpoint" --every 4 --out "$dir/out/reach-full" \
    >/dev/null 2>"$dir/out/full.log" || code=$?
grep -m1 'No space left' "$dir/out/full.log" | sed 's/^/    /'
same "reach whose checkpoints found no space" "$dir/out/reach" "$dir/out/reach-full"
[ -z "$(ls -A "$dir/full")" ] && good "no half file" || bad "left: $(ls -A "$dir/full")"
umount "$dir/full"

say "$([ $failed -eq 0 ] && echo "All as with one process" || echo "FAILED")"
exit $failed
