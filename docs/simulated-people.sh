#!/bin/sh
# One shard of simulated people for each task of a Slurm array, in a library of its own:
#
#   sbatch --array=1-64 docs/simulated-people.sh CASES.sdbundle FOLDER --case CASE --operator novice --people 10000
#
# CASES.sdbundle is what `seldinger bundle export` wrote; what follows FOLDER goes to `seldinger simulate`. A task that
# was cut off is begun again with the same words and makes what is missing. When all are done, on one machine:
#
#   for shard in FOLDER/shard-*; do seldinger simulate merge "$shard" --library LIBRARY; done
#
# SELDINGER names the program where it is not on the PATH.
#SBATCH --job-name=simulated-people
#SBATCH --cpus-per-task=1
set -eu
cases=$1 folder=$2
shift 2
program=${SELDINGER:-seldinger}
library=$folder/shard-$SLURM_ARRAY_TASK_ID
"$program" bundle import "$cases" --new-library --library "$library"
exec "$program" simulate --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --no-pictures \
  --jobs "${SLURM_CPUS_PER_TASK:-1}" --library "$library" "$@"
