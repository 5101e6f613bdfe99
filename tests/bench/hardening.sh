#!/usr/bin/env bash
# tests/bench/hardening.sh [ROUNDS [STAGES]]
# What the hardened build (cmake/hardening.cmake) costs: builds seldinger-measure as it is shipped and without hardening, runs
# `bench --quick` of STAGES (step,mpr: a tick and a picture) in turns, ROUNDS (11) times each, and tells of each row on the CPU
# both least times (other work only adds) and the median of the ratios within a round.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
rounds=${1:-11} stages=${2:-step,mpr}

[ -f build/release/build.ninja ] || cmake --preset release >&2
[ -f build/unhardened/build.ninja ] || cmake --preset release -B build/unhardened -DSELDINGER_HARDENED=OFF >&2
cmake --build build/release --target seldinger-measure >&2
cmake --build build/unhardened --target seldinger-measure >&2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

printf 'machine: %s, %s cores, load %s\n' \
  "$(awk -F': ' '/model name/ {print $2; exit}' /proc/cpuinfo)" "$(nproc)" "$(cut -d' ' -f1 /proc/loadavg)"
for ((round = 0; round < rounds; ++round)); do
  builds=(release unhardened)
  ((round % 2 == 0)) || builds=(unhardened release)
  for build in "${builds[@]}"; do
    "build/$build/seldinger-measure" bench --stage "$stages" --quick --out "$folder/out" >/dev/null 2>&1
    # A row's cells, those with a comma in quotes: what it is, and its least time.
    sed -E ':a; s/^(([^"]*"[^"]*")*[^"]*"[^",]*),/\1;/; ta; s/"//g' "$folder/out/results.csv" |
      awk -F, -v build="$build" -v round="$round" '$4 == "cpu" {print $1 " " $2 " " $3 ", " $5 "\t" build "\t" round "\t" $9}' \
        >>"$folder/all.tsv"
  done
done
awk -F'\t' '
  {at[$1, $2, $3] = $4; if (!(($1, $2) in least) || $4 < least[$1, $2]) least[$1, $2] = $4; if (!seen[$1]++) row[++rows] = $1; if ($3 >= rounds) rounds = $3 + 1}
  END {
    printf "%-66s %12s %12s %8s\n", "least ms, and median of ratios", "hardened", "without", "ratio"
    for (i = 1; i <= rows; ++i) {
      n = 0
      for (r = 0; r < rounds; ++r) ratio[++n] = at[row[i], "release", r] / at[row[i], "unhardened", r]
      for (a = 2; a <= n; ++a) for (b = a; b > 1 && ratio[b] < ratio[b - 1]; --b) {t = ratio[b]; ratio[b] = ratio[b - 1]; ratio[b - 1] = t}
      printf "%-66s %12.6g %12.6g %8.3f\n", row[i], least[row[i], "release"], least[row[i], "unhardened"], ratio[int((n + 1) / 2)]
    }
  }' "$folder/all.tsv"
