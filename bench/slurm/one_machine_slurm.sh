#!/usr/bin/env bash
# A Slurm of one node, this machine, for tests: all that it writes is in one folder.
#   one_machine_slurm.sh start FOLDER [CPUS]   then: export SLURM_CONF=FOLDER/slurm.conf
#   one_machine_slurm.sh node FOLDER           the node's daemon alone, after it was ended
#   one_machine_slurm.sh stop FOLDER
# Needs slurm-wlm and munge of Debian, and root, as Slurm's node daemon does. No systemd and no
# cgroups: processes are told apart by their parents.
set -euo pipefail
action=${1:?start, node or stop}
folder=$(mkdir -p "${2:?a folder}" && cd "$2" && pwd)
cpus=${3:-$(nproc)}

free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])'
}

write_config() {
  local host
  host=$(hostname -s)
  cat >"$folder/slurm.conf" <<END
ClusterName=one_machine
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,bf_interval=5
ReturnToService=2
SlurmdTimeout=300
MinJobAge=3600
JobRequeue=1
MaxArraySize=1001
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cpus State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
END
  echo 'CgroupPlugin=cgroup/v1' >"$folder/cgroup.conf"
}

start_munge() {
  # The socket's folder must be open to those who ask, the key closed to them.
  chmod 755 "$folder"
  if [ ! -f "$folder/munge.key" ]; then
    (umask 077 && head -c 128 /dev/urandom >"$folder/munge.key")
  fi
  munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
    --pid-file="$folder/munged.pid" --log-file="$folder/munged.log" \
    --seed-file="$folder/munge.seed"
}

start_node() { slurmd -f "$folder/slurm.conf" -N "$(hostname -s)"; }

wait_until_up() {
  local state
  for _ in $(seq 300); do
    state=$(sinfo --noheader --format=%T 2>/dev/null || true)
    case $state in
      '' | down* | unk* | future* | inval* | drain*) sleep 0.2 ;;
      *) return 0 ;;
    esac
  done
  echo "the node is $state" >&2
  tail -n 5 "$folder/slurmctld.log" "$folder/slurmd.log" >&2 || true
  echo "the node did not come up" >&2
  return 1
}

stop_daemon() {
  local pid
  pid=$(cat "$folder/$1.pid" 2>/dev/null) || return 0
  kill "$pid" 2>/dev/null || return 0
  for _ in $(seq 50); do
    kill -0 "$pid" 2>/dev/null || return 0
    sleep 0.1
  done
  kill -9 "$pid" 2>/dev/null || true
}

export SLURM_CONF=$folder/slurm.conf
case $action in
  start)
    mkdir -p "$folder/state" "$folder/spool"
    write_config
    start_munge
    slurmctld -f "$folder/slurm.conf"
    start_node
    wait_until_up
    ;;
  node)
    start_node
    wait_until_up
    ;;
  stop)
    for daemon in slurmd slurmctld munged; do stop_daemon "$daemon"; done
    ;;
  *)
    echo "one_machine_slurm.sh: $action: expected start, node or stop" >&2
    exit 2
    ;;
esac
