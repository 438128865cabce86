#!/usr/bin/env bash
# Renders a job array by a Slurm of one node that runs in a folder of its own: slurm_test.sh SOURCES IMPORTON
# Exits with 77, saying so, where Slurm's packages (slurmctld slurmd slurm-client munge) or root are missing.
set -euo pipefail
PATH=$PATH:/usr/sbin
for program in munged mungekey slurmctld slurmd sbatch; do
  if ! command -v "$program" > /dev/null; then
    echo "skipped: no $program (apt-get install slurmctld slurmd slurm-client munge)"
    exit 77
  fi
done
if ((EUID != 0)); then
  echo "skipped: slurmd needs root"
  exit 77
fi

folder=$(mktemp -d)
stop() {
  local file
  for file in slurmctld slurmd munged; do
    if [[ -e $folder/$file.pid ]]; then kill "$(< "$folder/$file.pid")" 2> /dev/null || true; fi
  done
  sleep 1
  rm -rf "$folder"
}
trap stop EXIT
chmod 755 "$folder"
mkdir "$folder/state" "$folder/spool"
node=$(hostname -s)
cat > "$folder/slurm.conf" << CONF
ClusterName=test
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=26817
SlurmdPort=26818
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
ReturnToService=2
MailProg=/bin/true
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$folder/slurm.conf
mungekey --create --keyfile="$folder/munge.key"
munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
  --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"
slurmctld
slurmd
for ((i = 0; i < 50; ++i)); do
  if sinfo -h -o %t 2> /dev/null | grep -q idle; then break; fi
  sleep 0.2
done
sinfo
"$(dirname "${BASH_SOURCE[0]}")/render_array_test.sh" "$1" "$2" slurm
