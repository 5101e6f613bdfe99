#!/bin/sh
# How many simulated people pass each drill and graded case at their first attempt, as a table, from nothing but the
# program (docs/simulated-people.md):
#
#   docs/pass-rates.sh FOLDER >pass-rates.md
#
# FOLDER is made a library of the drills and the graded cases (`seldinger demo --cases`), if it is none yet. What is
# stored in it already is not simulated again, so a run that was cut off is begun again with the same words.
#
# SELDINGER names the program where it is not on the PATH; PEOPLE (12) how many of each group, SEED (3) which.
set -eu
library=$1
program=${SELDINGER:-seldinger} people=${PEOPLE:-12} seed=${SEED:-3}
[ -e "$library" ] || "$program" demo --cases --no-serve --library "$library" >&2
# The verdict is what `attempt list` says of each; a case without a rule has none, and is left out.
passed_of() {
  "$program" simulate --case "$1" --operator "$2" --people "$people" --seed "$seed" --no-pictures --json \
    --library "$library" | grep -o '"verdict": *"[a-z_]*"' |
    awk '/passed/ { passed++ } /passed|failed/ { graded++ } END { if (graded) print passed + 0 " of " graded; else print "no rule" }'
}
printf '| | simulated novices | simulated experts |\n|---|---|---|\n'
"$program" case list --library "$library" | sed -n 's/^\([0-9a-f-]\{36\}\) .*/\1/p' | while read -r id; do
  title=$("$program" case show "$id" --json --library "$library" | sed -n 's/^ *"title": "\(.*\)",$/\1/p' | head -n 1)
  printf '| %s | %s | %s |\n' "$title" "$(passed_of "$id" novice)" "$(passed_of "$id" expert)"
done
