#!/usr/bin/env bash
# tests/bench/window.sh OUT_FOLDER [SECONDS] [OPTIONS OF TRAIN …]
# The trainer's window with both hands at work for SECONDS (30): rates, lags from hand to force, room and guidance at the
# swap, what the servo kept meanwhile, cold start and memory. Of the built-in torso into OUT_FOLDER/results.csv and, at
# 1920 × 1080, results_1920.csv; of a real CT (with contrast, of the folder SELDINGER_DATA) into
# OUT_FOLDER/results_ct.csv. On a screen of its own (Xvfb, xdotool); GL is what there is, on a machine without a GPU llvmpipe. Wants a machine that does nothing else; the load is told with the rows.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=${1:?OUT_FOLDER}
seconds=${2:-30}
shift $(($# > 1 ? 2 : 1))
[ -f build/release/build.ninja ] || cmake --preset release >&2
cmake --build build/release --target seldinger window_bench >&2
bench=build/release/tests/bench/window_bench program=$PWD/build/release/seldinger ct=$(realpath -m "${SELDINGER_DATA:-../shared/data}")/ct-abdomen-contrast-dicom
mkdir -p "$out"
"$bench" "$program" "$out/results.csv" "$seconds" -- "$@" >&2
"$bench" "$program" "$out/results_1920.csv" "$seconds" -- --width 1920 --height 1080 "$@" >&2
if [ -d "$ct" ]; then
  "$bench" "$program" "$out/results_ct.csv" "$seconds" --ct "$ct" -- "$@" >&2
else
  echo "no $ct: only the built-in torso was measured" >&2
fi
tail -n +1 "$out"/results*.csv
