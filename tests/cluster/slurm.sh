# SPDX-License-Identifier: AGPL-3.0-or-later
#
# A real Slurm of two virtual nodes, n1 and n2, without systemd, with ports, keys and folders of its own; ctest starts it once
# for all tests that need it. No processes but its own are touched: munged and Slurm's daemons that have its SLURM_CONF.
#
#   sh slurm.sh start FOLDER    starts it; it ends by itself when the caller (ctest) does
#   sh slurm.sh stop FOLDER     ends it, and fails if anything of it is left
#   . slurm.sh; slurm_use FOLDER    in a test: two idle nodes, whatever the test before did to them
#
# Exit 77: Slurm is not installed.

slurm_programs() {
	for slurm_program in munged slurmctld slurmd sbatch; do
		command -v $slurm_program > /dev/null 2>&1 || PATH=$PATH:/usr/sbin
		command -v $slurm_program > /dev/null 2>&1 || { echo "skipped: no $slurm_program here; cmake/setup.sh installs slurm-wlm and munge"; exit 77; }
	done
}

# Three free ports of this machine, asked of the kernel. Another program may take one before Slurm does: then others are tried.
slurm_ports() {
	python3 -c 'import socket
held = [socket.socket() for i in range(3)]
for s in held: s.bind(("127.0.0.1", 0))
print(*[s.getsockname()[1] for s in held])'
}

# cred_expire is how long a requeued job waits, by default two minutes.
slurm_config() { # FOLDER PORT PORT PORT
	host=$(hostname -s)
	user=$(id -un)
	cat > "$1/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$2
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
KillWait=1
MinJobAge=600
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=10000,max_rpc_cnt=0
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$3 CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$4 CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
}

# A process of Slurm's outlives the shell that starts it, and holds none of its pipes.
slurm_daemon() { # OUTPUT COMMAND...
	slurm_out=$1
	shift
	setsid "$@" > "$slurm_out" 2>&1 < /dev/null &
}

slurm_node() { # FOLDER NODE: starts its slurmd
	mkdir -p "$1/spool-$2"
	slurm_daemon "$1/slurmd-$2.out" slurmd -D -N "$2" -f "$1/slurm.conf"
}

slurm_daemons() { # FOLDER
	slurm_daemon "$1/munge/out" munged --foreground --force --key-file="$1/munge/key" --socket="$1/munge/socket" \
		--pid-file="$1/munge/pid" --log-file="$1/munge/log" --seed-file="$1/munge/seed" --num-threads=2
	slurm_wait munged test -S "$1/munge/socket" || return 1
	slurm_daemon "$1/slurmctld.out" slurmctld -D -f "$1/slurm.conf"
	slurm_node "$1" n1
	slurm_node "$1" n2
	slurm_wait "two idle nodes" slurm_settled "$1" && slurm_idle
}

slurm_idle() { [ "$(sinfo --noheader --Node --format=%T 2> /dev/null | grep -c '^idle$')" = 2 ]; }

# Idle, or one of the daemons has ended: a port was taken.
slurm_settled() { slurm_idle || [ "$(slurm_processes "$1" | wc -l)" -lt 4 ]; }

# slurm_wait WHAT COMMAND...: until it succeeds, at most a minute.
slurm_wait() {
	slurm_what=$1
	shift
	slurm_end=$(($(date +%s) + 60))
	until "$@"; do
		[ "$(date +%s)" -lt $slurm_end ] || { echo "FAILED: no $slurm_what after a minute"; tail -n 5 "${SLURM_CONF%/*}"/*.log; return 1; }
		sleep 0.1
	done
}

# Ids of its daemons, and of those that watch over running jobs. They have its SLURM_CONF; with NODE: its log too.
slurm_processes() { # FOLDER [NODE]
	for slurm_process in $(ps -eo pid=,comm= | awk '$2 ~ /^(munged|slurmctld|slurmd|slurmstepd)/ { print $1 }'); do
		grep -zqxF "SLURM_CONF=$1/slurm.conf" /proc/$slurm_process/environ 2> /dev/null || continue
		[ $# = 1 ] || ls -l /proc/$slurm_process/fd 2> /dev/null | grep -q "slurmd-$2.log" || continue
		echo $slurm_process
	done
}

# A process and all below it, the ones below first.
slurm_kill_tree() { # SIGNAL PID
	for slurm_child in $(ps -o pid= --ppid "$2" 2> /dev/null); do
		slurm_kill_tree "$1" "$slurm_child"
	done
	kill "-$1" "$2" 2> /dev/null
}

slurm_kill() { # SIGNAL FOLDER [NODE]
	slurm_signal=$1
	shift
	for slurm_victim in $(slurm_processes "$@"); do
		slurm_kill_tree $slurm_signal "$slurm_victim"
	done
}

# A node loses its power, and its cluster hears of it at once (by itself it would after SlurmdTimeout, some 30 s here).
slurm_kill_node() { # FOLDER NODE
	slurm_kill KILL "$1" "$2"
	scontrol update NodeName="$2" State=DOWN Reason=test
}

# Whether a node runs a program of this name.
slurm_runs() { # FOLDER NODE NAME
	for slurm_process in $(slurm_processes "$1" "$2"); do
		for slurm_child in $(ps -o pid= --ppid $slurm_process); do
			slurm_below $slurm_child "$3" && return 0
		done
	done
	return 1
}

slurm_below() { # PID NAME
	[ "$(ps -o comm= -p $1)" != "$2" ] || return 0
	for slurm_grandchild in $(ps -o pid= --ppid $1); do
		slurm_below $slurm_grandchild "$2" && return 0
	done
	return 1
}

slurm_gone() { [ -z "$(slurm_processes "$1")" ]; }

slurm_stop() { # FOLDER
	scancel --user="$(id -un)" 2> /dev/null
	slurm_kill TERM "$1"
	for slurm_try in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
		! slurm_gone "$1" || break
		sleep 0.1
	done
	slurm_kill KILL "$1"
	slurm_wait "end of Slurm" slurm_gone "$1"
}

slurm_prepare() { # FOLDER
	SLURM_CONF=$1/slurm.conf
	export SLURM_CONF
}

slurm_use() { # FOLDER
	slurm_programs
	slurm_prepare "$1"
	squeue --noheader --format=%i 2> /dev/null | xargs -r scancel
	for slurm_each in n1 n2; do
		[ -n "$(slurm_processes "$1" $slurm_each)" ] || { slurm_node "$1" $slurm_each; scontrol update NodeName=$slurm_each State=RESUME; }
	done
	slurm_wait "two idle nodes" slurm_idle || exit 1
}

# Watches over the daemons until FOLDER/stop appears or the process OWNER ends, and ends them then.
slurm_guard() { # FOLDER OWNER
	for slurm_attempt in 1 2 3 4 5; do
		rm -rf "$1/munge" "$1/state" "$1"/spool-* "$1"/*.log
		mkdir -p "$1/munge" "$1/state" && chmod 700 "$1/state" && chmod 755 "$1" "$1/munge"
		(umask 077 && dd if=/dev/urandom of="$1/munge/key" bs=128 count=1 2> /dev/null)
		# The first try's ports may be given, by the test that takes them first.
		set -- "$1" "$2" ${SLURM_TEST_PORTS:-$(slurm_ports)}
		unset SLURM_TEST_PORTS
		slurm_config "$1" "$3" "$4" "$5"
		slurm_daemons "$1" && { echo $slurm_attempt > "$1/ready"; break; }
		echo "attempt $slurm_attempt:"; tail -n 3 "$1"/*.log
		slurm_stop "$1"
		set -- "$1" "$2"
	done
	if [ -e "$1/ready" ]; then
		while [ ! -e "$1/stop" ] && kill -0 "$2" 2> /dev/null; do
			sleep 0.2
		done
	fi
	slurm_stop "$1"
	: > "$1/ended"
}

case ${0##*/}:${1:-} in
slurm.sh:start)
	slurm_programs
	[ ! -e "$2/ready" ] || { : > "$2/stop"; slurm_prepare "$2"; slurm_stop "$2"; }   # a run before this was killed together with its guard
	rm -rf "$2" && mkdir -p "$2" || exit 1
	setsid sh "$0" guard "$2" "${3:-$PPID}" > "$2/guard.out" 2>&1 < /dev/null &
	slurm_wait "Slurm" sh -c "[ -e '$2/ready' ] || [ -e '$2/ended' ]" 2> /dev/null
	[ -e "$2/ready" ] || { cat "$2/guard.out"; exit 1; }
	echo "started at attempt $(cat "$2/ready")" ;;
slurm.sh:guard)
	slurm_prepare "$2"
	slurm_guard "$2" "$3" ;;
slurm.sh:stop)
	slurm_programs
	slurm_prepare "$2"
	: > "$2/stop"
	slurm_wait "end of Slurm" test -e "$2/ended" || exit 1
	slurm_gone "$2" || { echo "FAILED: left: $(slurm_processes "$2")"; exit 1; } ;;
esac
