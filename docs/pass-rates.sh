#!/bin/sh
# How many simulated people pass each case of the demo at their first attempt, as a table in Markdown:
#
#   docs/pass-rates.sh LIBRARY
#
# LIBRARY is made where there is none yet (`seldinger demo --cases`). Attempts are kept in it, so that a run that was cut
# off goes on with the same words.
#
# SELDINGER names the program where it is not on the PATH; PEOPLE (12) how many of a group attempt each case, SEED (3)
# which ones.
set -eu
library=$1
program=${SELDINGER:-seldinger} people=${PEOPLE:-12} seed=${SEED:-3}
if [ ! -e "$library" ]; then  # under its name once it is whole
  rm -rf "$library.part"
  "$program" demo --cases --no-serve --library "$library.part" >&2
  mv "$library.part" "$library"
fi
# Who gave up or lost the device did not pass; a case without a rule has no verdicts.
passed_of() {
  answer=$("$program" simulate --case "$1" --operator "$2" --people "$people" --seed "$seed" --no-pictures --json \
    --library "$library") || exit
  printf %s "$answer" | grep -o '"verdict": *"[a-z_]*"' |
    awk '/"passed"/ { passed++ } !/no_rule/ { made++ } END { if (made) print passed + 0 " of " made; else print "no rule" }'
}
cases=$("$program" case list --library "$library")
printf '| | simulated novices | simulated experts |\n|---|---|---|\n'
for id in $(printf '%s\n' "$cases" | sed -n 's/^\([0-9a-f-]\{36\}\) .*/\1/p'); do
  title=$("$program" case show "$id" --json --library "$library" | sed -n 's/^ *"title": "\(.*\)",$/\1/p' | head -n 1)
  novices=$(passed_of "$id" novice)
  experts=$(passed_of "$id" expert)
  printf '| %s | %s | %s |\n' "$title" "$novices" "$experts"
done
