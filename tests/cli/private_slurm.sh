#!/bin/bash
# Starts or stops a Slurm of one node in a folder of its own: private_slurm.sh start|stop FOLDER
# `start` prints nothing on success, else one line that says why it cannot start. Clients find the
# cluster by SLURM_CONF=FOLDER/slurm.conf.
set -uo pipefail

action=$1
folder=$2
export PATH=$PATH:/usr/sbin:/sbin

stop() {
  local name pid
  # The controller and the node are killed at once, as an orderly end takes them five seconds. Their
  # steps would then wait for them, so that no job may be left.
  export SLURM_CONF=$folder/slurm.conf
  if [[ -s $folder/slurmctld.pid ]]; then
    timeout 5 scancel --user="$(id -un)" 2>/dev/null
    for _ in $(seq 30); do
      [[ -z $(timeout 5 squeue -h 2>&1) ]] && break
      sleep 0.1
    done
  fi
  for name in slurmd slurmctld munged; do
    [[ -s $folder/$name.pid ]] || continue
    pid=$(<"$folder/$name.pid")
    kill -9 "$pid" 2>/dev/null
  done
  for pid in $(pgrep slurmstepd); do
    [[ $(readlink "/proc/$pid/cwd") == "$folder"* ]] && kill -9 "$pid" 2>/dev/null
  done
  true
}

fail() {
  stop
  echo "$1"
  exit 1
}

# Three free ports of this machine, from one that depends on the process.
free_port() {
  local port=$1
  while (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do port=$((port + 3)); done
  echo "$port"
}

start() {
  local program
  for program in munged mungekey slurmctld slurmd sbatch squeue; do
    command -v "$program" >/dev/null || fail "there is no $program here"
  done
  local user host ports
  user=$(id -un)
  host=$(hostname -s)
  ports=$(free_port $((20000 + $$ % 20000)))
  mkdir -p "$folder/munge" "$folder/state" "$folder/spool"
  chmod 700 "$folder/munge"
  mungekey --create --keyfile "$folder/munge/key" 2>/dev/null || fail "no key can be made for munge"
  munged --force --socket="$folder/munge/socket" --key-file="$folder/munge/key" --pid-file="$folder/munged.pid" \
    --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" --num-threads=2 2>"$folder/munge/said" ||
    fail "munged does not start: $(head -1 "$folder/munge/said")"
  cat >"$folder/slurm.conf" <<CONF
ClusterName=private
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
SlurmctldPort=$ports
SlurmdPort=$((ports + 1))
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
PriorityType=priority/basic
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=5
InactiveLimit=0
KillWait=2
MinJobAge=300
MaxArraySize=100
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 Boards=1 SocketsPerBoard=1 CoresPerSocket=2 ThreadsPerCore=1 RealMemory=4000
PartitionName=main Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
  # Slurm 24 starts without control groups only where they are switched off; version 22 knows no such word.
  local version
  version=$(slurmd -V)
  [[ ${version//[^0-9.]/} == 22.* ]] || echo "CgroupPlugin=disabled" >"$folder/cgroup.conf"
  export SLURM_CONF=$folder/slurm.conf
  slurmctld -f "$SLURM_CONF" -c >"$folder/slurmctld.said" 2>&1 || fail "slurmctld does not start: $(tail -1 "$folder/slurmctld.said")"
  slurmd -f "$SLURM_CONF" -N "$host" >"$folder/slurmd.said" 2>&1 || fail "slurmd does not start: $(tail -1 "$folder/slurmd.said")"
  for _ in $(seq 100); do
    [[ $(sinfo -h -o %T 2>/dev/null) == idle ]] && return
    sleep 0.1
  done
  fail "the node does not come up: $(sinfo -h -o '%T %E' 2>&1 | head -1)"
}

"$action"
