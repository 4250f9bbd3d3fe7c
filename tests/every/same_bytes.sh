#!/usr/bin/env bash
# Same bytes on a rerun and, for the pipeline's stages, with one thread and with two; the solver agrees to 1e-8 there.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
source tests/every/small_study/stages.bash
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
make_small_study "$bin" "$folder/study"

for stage in $all_stages; do
  for run in first again one-thread two-threads; do
    threads=()
    case $run in one-thread) threads=(--threads=1) ;; two-threads) threads=(--threads=2) ;; esac
    mkdir -p "$folder/$stage/$run"
    call_stage "$bin" "$stage" "$folder/study" "$folder/$stage/$run" --quiet "${threads[@]}"
    bytes_of "$folder/$stage/$run" >"$folder/$stage.$run"
  done
  cmp "$folder/$stage.first" "$folder/$stage.again" || { echo "$stage: other bytes on a rerun" >&2; exit 1; }
  if [ "$stage" != solve ]; then
    cmp "$folder/$stage.one-thread" "$folder/$stage.two-threads" || { echo "$stage: other bytes with two threads" >&2; exit 1; }
  fi
done

# Relative to the largest number of the column: 1e-8 (docs/formats.md).
paste -d, "$folder"/solve/{one-thread,two-threads}/soft/history.csv | awk -F, '
  NR == 1 { half = NF / 2; next }
  { for (i = 1; i <= half; ++i) { a = $i; b = $(i + half); m = a < 0 ? -a : a; if (m > most[i]) most[i] = m; d = a - b; if (d < 0) d = -d; if (!(d <= off[i])) off[i] = d } }
  END { for (i = 1; i <= half; ++i) if (!(off[i] <= 1e-8 * most[i])) { print "column " i " differs by " off[i] " of " most[i]; bad = 1 } exit bad + 0 }'
