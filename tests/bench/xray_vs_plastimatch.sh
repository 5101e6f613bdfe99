#!/usr/bin/env bash
# tests/bench/xray_vs_plastimatch.sh [RUNS]
# Our X-ray projectors and `plastimatch drr` on one volume, in one geometry, with equal threads, in one run. RUNS (5)
# rounds, each of the peer's pictures and then ours, so that what else the machine does falls on both; medians over the
# rounds. Prints both times, the ratio, and the difference of the two pictures (nepers; relative where more than 0.05
# are absorbed): exact and exact must agree to rounding, slab and uniform are different interpolations. Volume and
# geometry: README.md beside this file. Installs plastimatch from Debian when it is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
runs=${1:-5}

say() { printf '== %s\n' "$*" >&2; }

if ! command -v plastimatch >/dev/null; then
  say "installing plastimatch"
  root=()
  [ "$(id -u)" -eq 0 ] || root=(sudo)
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q >&2
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends plastimatch >&2
fi
[ -f build/release/build.ninja ] || cmake --preset release >&2
cmake --build build/release --target xray_peer >&2
peer=build/release/tests/bench/xray_peer
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$peer" volume "$folder/volume.mha"

# The first core for one thread, all for more. Both sides the same.
on_cores() { # THREADS COMMAND...
  local threads=$1; shift
  if [ "$threads" = 1 ]; then taskset -c 0 "$@"; else "$@"; fi
}

median() { sort -n | awk '{v[NR] = $1} END {print v[int((NR + 1) / 2)]}'; }

declare -A pixels=([G1]="512 512" [G2]="624 420") size_mm=([G1]="600 600" [G2]="400 269.2307692307692")

# ms of the projection alone: plastimatch's total without reading, less its writing.
time_peer() { # METHOD THREADS GEOMETRY
  OMP_NUM_THREADS=$2 on_cores "$2" plastimatch drr -i "$1" -a 1 -N 90 -y 7 --sad 1000 --sid 1500 \
    -r "${pixels[$3]}" -z "${size_mm[$3]}" -t pfm -O "$folder/${1}_$3_" "$folder/volume.mha" |
    awk '/^I\/O time/ {io = $3} /^Total time/ {printf "%.2f\n", 1000 * ($3 - io)}'
}

printf 'machine: %s, %s cores, load %s\n' \
  "$(awk -F': ' '/model name/ {print $2; exit}' /proc/cpuinfo)" "$(nproc)" "$(cut -d' ' -f1 /proc/loadavg)"
for threads in 1 2; do
  [ "$threads" -le "$(nproc)" ] || continue
  words="$threads thread"; [ "$threads" = 1 ] || words+=s
  for ((round = 0; round < runs; ++round)); do
    for geometry in G1 G2; do
      for method in exact uniform; do
        echo "$(time_peer "$method" "$threads" "$geometry")" >>"$folder/plastimatch-$threads-$method-$geometry"
      done
    done
    LP_NUM_THREADS=$threads on_cores "$threads" "$peer" ours "$threads" 1 "$folder" >"$folder/ours-$threads"
    while read -r method _ geometry backend ms _; do
      echo "$ms" >>"$folder/ours-$threads-$method-$geometry-$backend"
    done <"$folder/ours-$threads"
  done
  for geometry in G1 G2; do
    for method in exact uniform; do
      printf 'plastimatch %s %s %s %s ms\n' "$method" "$words" "$geometry" \
        "$(median <"$folder/plastimatch-$threads-$method-$geometry")"
    done
  done
  # The last round's pictures: all rounds' are the same.
  while read -r method _ geometry backend _ largest mean; do
    against=$method; [ "$method" = exact ] || against=uniform
    peer_ms=$(median <"$folder/plastimatch-$threads-$against-$geometry")
    ms=$(median <"$folder/ours-$threads-$method-$geometry-$backend")
    printf 'ours %s %s %s %s %s ms; difference from %s: largest %s nepers, mean %s\n' \
      "$method" "$words" "$geometry" "$backend" "$ms" "$against" "$largest" "$mean"
    printf 'ratio %s %s %s %s %.1f\n' "$method" "$words" "$geometry" "$backend" \
      "$(awk -v a="$peer_ms" -v b="$ms" 'BEGIN {print a / b}')"
  done <"$folder/ours-$threads"
done
