#!/usr/bin/env bash
# A full disk is an error (exit 3) that says so, of every stage, and nothing is left behind.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
source tests/every/small_study/stages.bash
folder=$(mktemp -d)
disk=$folder/disk
mkdir "$disk"
trap 'umount "$disk" 2>/dev/null || true; rm -rf "$folder"' EXIT
if ! mount -t tmpfs -o size=16k tmpfs "$disk" 2>/dev/null; then
  echo "skipped: no permission to mount a small tmpfs, so no disk could be filled"
  exit 0
fi
make_small_study "$bin" "$folder/study"

# At 4k and 0k free, so that the writers fail early and late; the last bytes a stage writes are its card.
for stage in $all_stages; do
  for blocks in 0 1 2; do
    find "$disk" -mindepth 1 -delete
    dd if=/dev/zero of="$disk/filler" bs=4k count=$((4 - blocks)) 2>/dev/null || true
    code=0
    call_stage "$bin" "$stage" "$folder/study" "$disk" --quiet >"$folder/out" 2>"$folder/err" || code=$?
    [ $code -eq 3 ] || { echo "$stage with $((4 * blocks)) kB free: exit code $code, not 3" >&2; cat "$folder/err" >&2; exit 1; }
    grep -qiE 'space|write' "$folder/err" || { echo "$stage: the message does not tell of the disk" >&2; cat "$folder/err" >&2; exit 1; }
    left=$(find "$disk" -mindepth 1 -not -name filler)
    [ -z "$left" ] || { echo "$stage left behind: $left" >&2; exit 1; }
  done
done
