# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Sourced by the cluster tests: a real Slurm of two virtual nodes, n1 and n2, without systemd, with ports, keys and folders
# of its own; it ends with the test. No processes but its own are touched: their ids are those that it started.
#
#   slurm_start FOLDER    and the commands of Slurm are there, on this cluster
#   slurm_stop

slurm_processes=""

# A free port of this machine, asked of the kernel, so that two tests at once do not meet.
slurm_free_port() {
	python3 -c 'import socket
s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

# cred_expire is how long a requeued job waits, by default two minutes.
slurm_config() { # FOLDER
	host=$(hostname -s)
	user=$(id -un)
	cat > "$1/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(slurm_free_port)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$1/munge/socket,cred_expire=6
CredType=cred/munge
StateSaveLocation=$1/state
SlurmctldPidFile=$1/slurmctld.pid
SlurmctldLogFile=$1/slurmctld.log
SlurmdPidFile=$1/slurmd-%n.pid
SlurmdSpoolDir=$1/spool-%n
SlurmdLogFile=$1/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SlurmdTimeout=20
KillWait=3
MinJobAge=600
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=10000,max_rpc_cnt=0
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$(slurm_free_port) CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$(slurm_free_port) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
}

slurm_node() { # FOLDER NODE: starts its slurmd
	mkdir -p "$1/spool-$2"
	slurmd -D -N "$2" -f "$1/slurm.conf" > "$1/slurmd-$2.out" 2>&1 &
	eval "slurmd_$2=$!"
	slurm_processes="$slurm_processes $!"
}

slurm_start() {
	for program in munged slurmctld slurmd sbatch; do
		command -v $program > /dev/null 2>&1 || PATH=$PATH:/usr/sbin
		command -v $program > /dev/null 2>&1 || { echo "no $program; cmake/setup.sh installs slurm-wlm"; exit 1; }
	done
	mkdir -p "$1/munge" "$1/state" && chmod 700 "$1/state" && chmod 755 "$1" "$1/munge"
	slurm_config "$1"
	SLURM_CONF=$1/slurm.conf
	export SLURM_CONF
	dd if=/dev/urandom of="$1/munge/key" bs=128 count=1 2> /dev/null
	chmod 400 "$1/munge/key"
	munged --foreground --force --key-file="$1/munge/key" --socket="$1/munge/socket" --pid-file="$1/munge/pid" \
		--log-file="$1/munge/log" --seed-file="$1/munge/seed" --num-threads=2 > "$1/munge/out" 2>&1 &
	slurm_processes="$!"
	slurm_wait "munged" test -S "$1/munge/socket"
	slurmctld -D -f "$1/slurm.conf" > "$1/slurmctld.out" 2>&1 &
	slurm_processes="$! $slurm_processes"
	slurm_node "$1" n1
	slurm_node "$1" n2
	slurm_wait "two idle nodes" slurm_idle 2
}

slurm_idle() { [ "$(sinfo --noheader --Node --format=%T 2> /dev/null | grep -c '^idle$')" = "$1" ]; }

# slurm_wait WHAT COMMAND...: until it succeeds, at most a minute.
slurm_wait() {
	slurm_what=$1
	shift
	slurm_tries=0
	until "$@"; do
		slurm_tries=$((slurm_tries + 1))
		[ $slurm_tries -lt 600 ] || { echo "FAILED: no $slurm_what after a minute"; tail -5 "${SLURM_CONF%/*}"/*.log; exit 1; }
		sleep 0.1
	done
}

# A process and all below it, the ones below first.
slurm_kill_tree() { # SIGNAL PID
	for slurm_child in $(ps -o pid= --ppid "$2" 2> /dev/null); do
		slurm_kill_tree "$1" "$slurm_child"
	done
	kill "-$1" "$2" 2> /dev/null
}

# Those that watch over running jobs leave slurmd's tree; they are this cluster's by their SLURM_CONF, a node's by its log.
slurm_steps() { # [NODE]
	for slurm_step in $(ps -eo pid=,comm= | awk '$2 ~ /^slurmstepd/ { print $1 }'); do
		tr '\0' '\n' < /proc/$slurm_step/environ 2> /dev/null | grep -qxF "SLURM_CONF=$SLURM_CONF" || continue
		[ $# = 0 ] || ls -l /proc/$slurm_step/fd 2> /dev/null | grep -q "slurmd-$1.log" || continue
		echo $slurm_step
	done
}

# A node loses its power, and its cluster hears of it at once (by itself it would after SlurmdTimeout, some 30 s here).
slurm_kill_node() { # NODE
	eval "slurm_kill_tree KILL \$slurmd_$1"
	for slurm_process in $(slurm_steps "$1"); do
		slurm_kill_tree KILL "$slurm_process"
	done
	scontrol update NodeName="$1" State=DOWN Reason=test
}

slurm_stop() {
	[ -n "$slurm_processes" ] || return 0
	scancel --user="$(id -un)" 2> /dev/null
	for slurm_process in $slurm_processes; do
		slurm_kill_tree TERM "$slurm_process"
	done
	sleep 0.3
	for slurm_process in $slurm_processes $(slurm_steps); do
		slurm_kill_tree KILL "$slurm_process"
	done
	wait 2> /dev/null
	slurm_processes=""
}
