#!/bin/sh
# One shard of simulated people for each task of a Slurm array:
#
#   sbatch --array=1-64 docs/simulated-people.sh 64 CASES.sdbundle FOLDER --case CASE --operator novice --people 10000
#
# 64 is how many shards there are in all: a task that was lost is begun again by itself, with the same words
# (--array=17). CASES.sdbundle is what `seldinger bundle export` wrote; what follows FOLDER goes to `seldinger simulate`.
# A library wants a disk of the machine itself (SLURM_TMPDIR or TMPDIR), not one that machines share: its shard lies
# packed in FOLDER, which they share, also when the task is told to end, and a task that begins again unpacks it. When
# all are done, on one machine:
#
#   for shard in FOLDER/shard-*.tar; do
#     rm -rf shard && mkdir shard && tar -xf "$shard" -C shard && seldinger simulate merge shard --library LIBRARY
#   done
#
# SELDINGER names the program where it is not on the PATH.
#SBATCH --job-name=simulated-people
#SBATCH --cpus-per-task=1
#SBATCH --signal=B:TERM@120
set -eu
shards=$1 cases=$2 folder=$3
shift 3
program=${SELDINGER:-seldinger}
shard=$SLURM_ARRAY_TASK_ID
packed=$folder/shard-$shard.tar
library=$(mktemp -d "${SLURM_TMPDIR:-${TMPDIR:-/tmp}}/shard-$shard.XXXXXX")
keep() {
  tar -cf "$packed.part" -C "$library" .
  mv "$packed.part" "$packed"
  rm -rf "$library"
}
[ ! -e "$packed" ] || tar -xf "$packed" -C "$library"
"$program" bundle import "$cases" --new-library --library "$library"
"$program" simulate --shard "$shard/$shards" --no-pictures --jobs "${SLURM_CPUS_PER_TASK:-1}" --library "$library" \
  "$@" &
trap 'kill -TERM $! 2>/dev/null || true; wait $! || true; keep; exit 1' TERM
wait $!
keep
