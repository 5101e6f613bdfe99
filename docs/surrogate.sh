#!/bin/sh
# A surrogate of a case, and all that is told of how well it does, from nothing but the program and a library:
#
#   docs/surrogate.sh FOLDER --case 'Drill 2' --library LIBRARY
#
# What FOLDER holds already is not made again, so that a run that was cut off is begun again with the same words. Parts
# come first that are needed first: with all levels and the half of the parts there is a surrogate, and every further
# part makes it a better one; STOP_AT (seconds since the epoch) says when no further part is begun. A case that has
# changed since, or a program with another law, wants another folder: `surrogate fit --from` refuses parts of both.
#
# SELDINGER names the program where it is not on the PATH; ATTEMPTS (3600) and HELD_OUT (500, of each level) how many.
set -eu
folder=$1
shift
program=${SELDINGER:-seldinger}
attempts=${ATTEMPTS:-3600} held_out=${HELD_OUT:-500} stop_at=${STOP_AT:-9999999999}
parts=12
mkdir -p "$folder"
made() {
  name=$1
  shift
  [ -e "$folder/$name.json" ] || [ "$(date +%s)" -ge "$stop_at" ] ||
    "$program" surrogate fit "$@" --out "$folder/$name.json"
}
part() {
  number=$1
  shift
  made "part-$number" --attempts "$attempts" --shard "$number/$parts" "$@"
}
for number in 1 2 3 4 5 6; do part $number "$@"; done
# People of another seed are others: the surrogate does not know them.
for group in novice intermediate expert; do made $group --group $group --attempts "$held_out" --seed 1000001 "$@"; done
for number in 7 8 9 10 11 12; do part $number "$@"; done
for shift in 0 0.8; do made "shift-$shift" --group $shift --attempts 300 --seed 1000001 "$@"; done

set --
for part in "$folder"/part-*.json; do set -- "$@" --from "$part"; done
rm -f "$folder/surrogate.json"  # of fewer parts
"$program" surrogate fit "$@" --out "$folder/surrogate.json"
# One that is off is told, and is no reason to tell nothing else.
told() {
  name=$1
  shift
  "$program" surrogate "$@" --surrogate "$folder/surrogate.json" >"$folder/$name".md || [ $? -eq 1 ]
}
set --
for level in novice intermediate expert shift-0 shift-0.8; do
  [ ! -e "$folder/$level.json" ] || set -- "$@" --against "$folder/$level.json"
done
told check check "$@"
told effects effects --chart "$folder/effects.svg"
told coverage coverage
