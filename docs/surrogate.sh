#!/bin/sh
# A surrogate of a case, and all that is told of how well it does, from nothing but the program and a library:
#
#   docs/surrogate.sh FOLDER --case 'Drill 2' --library LIBRARY
#
# What FOLDER holds already is not made again, so that a run that was cut off is begun again with the same words.
# Attempts come in parts. Those come first without which something cannot be told at all: a third of what the surrogate
# is fitted to, the pools at two shifts, the levels that it does not know; every further part makes it a better one.
# STOP_AT (seconds since the epoch) says when no further part is begun; what is told then is of the parts that are
# there. A case that has changed since, or a program with another law, wants another folder: `surrogate fit --from`
# refuses parts of both.
#
# SELDINGER names the program where it is not on the PATH; ATTEMPTS (3600) how many it is fitted to, HELD_OUT (500, of
# each level) and POOL (300, of each shift) how many it does not know.
set -eu
folder=$1
shift
program=${SELDINGER:-seldinger}
attempts=${ATTEMPTS:-3600} held_out=${HELD_OUT:-500} pool=${POOL:-300} stop_at=${STOP_AT:-9999999999}
mkdir -p "$folder"
# name: its parts are NAME-1.json, …; from, to, of: which parts of how many; then how they are made.
made() {
  name=$1 number=$2 to=$3 of=$4
  shift 4
  while [ "$number" -le "$to" ]; do
    [ -e "$folder/$name-$number.json" ] || [ "$(date +%s)" -ge "$stop_at" ] ||
      "$program" surrogate fit "$@" --shard "$number/$of" --out "$folder/$name-$number.json"
    number=$((number + 1))
  done
}
# The sum of the parts that are there, anew: there may be more of them than last time.
summed() {
  name=$1
  rm -f "$folder/$name.json"
  set --
  for part in "$folder/$name"-[0-9]*.json; do [ ! -e "$part" ] || set -- "$@" --from "$part"; done
  [ $# -eq 0 ] || "$program" surrogate fit "$@" --out "$folder/$name.json"
}
made part 1 4 12 --attempts "$attempts" "$@"
# People of another seed are others: the surrogate does not know them.
for shift in 0 0.8; do
  made "shift-$shift" 1 3 3 --group $shift --attempts "$pool" --seed 1000001 "$@"
done
for level in novice expert intermediate; do
  made $level 1 5 5 --group $level --attempts "$held_out" --seed 1000001 "$@"
done
made part 5 12 12 --attempts "$attempts" "$@"

# What is told stays while the surrogate does, but for the check, whose attempts may be more. One that is off is told,
# and is no reason to tell nothing else.
told() {
  name=$1
  shift
  [ ! -e "$folder/$name".md ] || return 0
  "$program" surrogate "$@" --surrogate "$folder/surrogate.json" >"$folder/$name".new || [ $? -eq 1 ]
  mv "$folder/$name".new "$folder/$name".md
}
forget() {
  for name in "$@"; do rm -f "$folder/$name".md "$folder/$name".svg; done
}
summed part
cmp -s "$folder/part.json" "$folder/surrogate.json" || forget effects distributions coverage
mv "$folder/part.json" "$folder/surrogate.json"
forget check
set --
for level in novice intermediate expert shift-0 shift-0.8; do
  summed $level
  [ ! -e "$folder/$level.json" ] || set -- "$@" --against "$folder/$level.json"
done
told check check "$@"
told effects effects --chart "$folder/effects.svg"
told distributions distributions --chart "$folder/distributions.svg"
told coverage coverage
