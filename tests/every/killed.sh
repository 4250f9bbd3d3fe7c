#!/usr/bin/env bash
# kill -9 at several moments of every stage: no half output, and the rerun makes the same bytes and leaves nothing temporary.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
source tests/every/small_study/stages.bash
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
make_small_study "$bin" "$folder/study"

temporary() { find "$1" -name '.partial-*' -o -name '*.partial*' | grep . ; }

exec_stage() { exec "$@"; }
killed=0
for stage in $all_stages; do
  mkdir -p "$folder/$stage/whole"
  start=$(date +%s%N)
  (call_stage "$bin" "$stage" "$folder/study" "$folder/$stage/whole" --quiet)
  nanoseconds=$(($(date +%s%N) - start))
  bytes_of "$folder/$stage/whole" >"$folder/whole"
  for percent in 15 50 80 90 97; do
    out=$folder/$stage/$percent
    mkdir -p "$out"
    call_stage "$bin" "$stage" "$folder/study" "$out" --quiet &
    pid=$!
    sleep "$(awk -v n=$nanoseconds -v p=$percent 'BEGIN { printf "%.3f", n * p / 1e11 }')"
    if kill -9 $pid 2>/dev/null; then killed=$((killed + 1)); fi
    wait $pid 2>/dev/null || true
    # What stands under its real name is whole: these very bytes.
    bytes_of "$out" | sed '/\/\.partial-/d' | while read -r line; do
      grep -qxF "$line" "$folder/whole" || { echo "$stage killed at $percent %: a half output: $line" >&2; exit 1; }
    done
    (call_stage "$bin" "$stage" "$folder/study" "$out" --quiet --force --skip-current >/dev/null) || { echo "$stage: the rerun failed" >&2; exit 1; }
    bytes_of "$out" | cmp - "$folder/whole" || { echo "$stage killed at $percent %: other bytes on the rerun" >&2; exit 1; }
    if temporary "$out"; then echo "$stage: something temporary is left" >&2; exit 1; fi
  done
done
echo "$killed runs killed"
[ $killed -ge 14 ] || { echo "too few runs were still alive when they were to be killed" >&2; exit 1; }
