#!/usr/bin/env bash
# A SLURM of one node, this machine, to try config/profiles/slurm on. As root, with Debian's packages slurm-wlm
# and munge:
#
#     tests/slurm/one_node.sh start|stop
#
# SLURM finds its configuration in /etc/slurm only: a machine that has another one there is left alone. All
# else, the keys of munge included, lives in one folder, which `stop` removes. Ended jobs: jobs.log in it.
set -euo pipefail

conf=/etc/slurm/slurm.conf
folder=/run/bladerub-slurm
mark="# written by tests/slurm/one_node.sh of bladerub"
daemons=(slurmd slurmctld munged) # in the order of stopping

fail() {
    echo "one_node.sh: $1" >&2
    exit 1
}

# The process of a daemon of ours, or nothing: the number in a pid file may be that of another one by now.
process() {
    local pid
    pid=$(cat "$folder/$1.pid" 2>/dev/null) || return 0
    if [[ $(readlink "/proc/$pid/exe") == */"$1"* ]]; then echo "$pid"; fi
}

wait_until() {
    local what=$1
    shift
    local end=$((SECONDS + 30))
    while ((SECONDS < end)); do
        if "$@" >/dev/null 2>&1; then return; fi
    done
    fail "$what; see the logs in $folder"
}

is_ours() { [[ -e $conf && $(head -n 1 "$conf") == "$mark" ]]; }
is_up() { [[ $(sinfo --noheader --format=%T) =~ ^(idle|mixed|allocated)$ ]]; }
is_empty() { [[ -z $(squeue --noheader) ]]; }
is_gone() { [[ -z $(process "$1") ]]; }

write_conf() {
    local host cpus memory
    host=$(hostname -s)
    cpus=$(nproc)
    memory=$(awk '/^MemTotal/ { print int($2 / 1024 * 0.9) }' /proc/meminfo)
    cat >"$conf" <<END
$mark
ClusterName=bladerub
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CryptoType=crypto/munge
MpiDefault=none
# no cgroups in containers; task/affinity keeps a job on the cores it asked for, as real clusters do
ProctrackType=proctrack/linuxproc
TaskPlugin=task/affinity
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
# without a database, squeue must remember jobs until Snakemake has asked for them
AccountingStorageType=accounting_storage/none
MinJobAge=300
JobCompType=jobcomp/filetxt
JobCompLoc=$folder/jobs.log
ReturnToService=2
KillWait=5
StateSaveLocation=$folder/slurmctld
SlurmdSpoolDir=$folder/slurmd
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cpus RealMemory=$memory
PartitionName=main Nodes=ALL Default=YES
END
}

start() {
    if [[ -e $conf ]] && ! is_ours; then fail "$conf is not ours: this machine has a SLURM of its own"; fi
    for command in munged mungekey slurmctld slurmd squeue; do
        command -v "$command" >/dev/null || fail "$command is missing: apt-get install slurm-wlm munge"
    done
    mkdir -p "$folder/slurmctld" "$folder/slurmd"
    write_conf
    if is_gone munged; then
        [[ -e $folder/munge.key ]] || mungekey --create --keyfile="$folder/munge.key"
        munged --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
            --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"
    fi
    if is_gone slurmctld; then slurmctld; fi
    if is_gone slurmd; then slurmd; fi
    wait_until "the node did not become ready" is_up
}

stop() {
    if [[ -e $conf ]] && ! is_ours; then fail "$conf is not ours: nothing to stop"; fi
    if [[ -n $(process slurmctld) ]]; then
        scancel --me
        wait_until "jobs go on after scancel" is_empty
    fi
    local pid
    for daemon in "${daemons[@]}"; do
        pid=$(process "$daemon")
        if [[ -n $pid ]]; then
            kill "$pid"
            wait_until "$daemon does not end" is_gone "$daemon"
        fi
    done
    rm -rf "$folder" "$conf"
}

[[ $EUID == 0 ]] || fail "needs root: SLURM's daemons change users and write to /etc/slurm"
case ${1-} in
start | stop) "$1" ;;
*) fail "say start or stop" ;;
esac
