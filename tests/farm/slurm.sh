#!/bin/sh
# Renders a still and a film of 24 frames on a Slurm of its own: two nodes on the loopback interface. One job is killed
# and one node drained midway; the merged bytes must be those of one run. Everything is stopped and removed at the end.
#
#   tests/farm/slurm.sh GLIMRAY SCENES
set -eu

glimray=$(realpath "$1")
scenes=$(realpath "$2")
folder=$(mktemp -d)
port=$((20000 + $$ % 20000))
user=$(id -un)

say() { echo "farm-test: $*"; }

stop() {
    status=$?
    trap - EXIT INT TERM
    for name in slurmd-1 slurmd-2 slurmctld munged; do
        if [ -s "$folder/$name.pid" ]; then
            kill "$(cat "$folder/$name.pid")" 2>/dev/null || true
        fi
    done
    sleep 1
    for name in slurmd-1 slurmd-2 slurmctld munged; do
        if [ -s "$folder/$name.pid" ]; then
            kill -KILL "$(cat "$folder/$name.pid")" 2>/dev/null || true
        fi
    done
    if [ "$status" -ne 0 ]; then
        tail -n 20 "$folder"/*.log "$work"/*.farm/logs/* 2>/dev/null || true
    fi
    rm -rf "$folder"
    exit "$status"
}
trap stop EXIT INT TERM

chmod 755 "$folder"
# A name that shells and Slurm could misread.
work="$folder/work 100%d #1"
mkdir "$folder/state" "$folder/spool-1" "$folder/spool-2" "$work"

# Authentication with a key of its own.
dd if=/dev/urandom of="$folder/munge.key" bs=128 count=1 status=none
chmod 400 "$folder/munge.key"
munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
    --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"

cat >"$folder/slurm.conf" <<CONF
ClusterName=glimray
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
ReturnToService=2
NodeName=1 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 State=UNKNOWN
NodeName=2 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 3)) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=1,2 Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF="$folder/slurm.conf"
export NODEVICE_SELECT=1

slurmctld -i -f "$SLURM_CONF"
slurmd -N 1 -f "$SLURM_CONF"
slurmd -N 2 -f "$SLURM_CONF"
for _ in $(seq 60); do
    [ "$(sinfo --noheader --states=idle --format=%D 2>/dev/null || true)" = 2 ] && break
    sleep 0.5
done
sinfo
[ "$(sinfo --noheader --states=idle --format=%D)" = 2 ] || {
    say "the nodes did not become idle"
    exit 1
}

cd "$work"
still="$scenes/cornell_box.toml --integrator path --size 96x96 --samples 512"
film="$scenes/orbits.toml --size 96x54 --samples 128 --frames 0..23"
# Paths without spaces, split on purpose.
# shellcheck disable=SC2086
"$glimray" render $still --quiet -o one.exr
# shellcheck disable=SC2086
"$glimray" animate $film --quiet -o one.mp4
# shellcheck disable=SC2086
"$glimray" farm plan $still --parts 8 --quiet -o still.exr
# shellcheck disable=SC2086
"$glimray" farm plan $film --parts 48 --quiet -o film.mp4

submitted=$("$glimray" farm submit still.exr.farm --engine slurm --time 10 --attempts 2)
say "$submitted"
array=$(echo "$submitted" | sed -n 's/^submitted job \([0-9]*\) .*/\1/p')
submitted=$("$glimray" farm submit film.mp4.farm --engine slurm --option comment=film)
say "$submitted"

# One task is killed while it runs.
for _ in $(seq 100); do
    task=$(squeue --noheader --states=R --job "$array" --format=%i | head -n 1)
    [ -z "$task" ] || break
    sleep 0.1
done
[ -n "$task" ] || {
    say "no task of the still ran"
    exit 1
}
limit=$(squeue --noheader --job "$task" --format=%l)
[ "$limit" = 10:00 ] || {
    say "the time limit is $limit, not 10 minutes"
    exit 1
}
sleep 0.3
scancel --signal=KILL "$task"
say "killed $task"
sleep 1
scontrol update NodeName=2 State=DRAIN Reason=test
say "drained node 2"

for _ in $(seq 600); do
    [ -n "$(squeue --noheader)" ] || break
    sleep 0.5
done
squeue
"$glimray" farm status still.exr.farm
"$glimray" farm status film.mp4.farm
cmp one.exr still.exr
cmp one.mp4 film.mp4
say "a still and a film have the bytes of one run"
