#!/usr/bin/env bash
# palpate-solve with scheme = "explicit", killed at any moment, goes on where it was, to the same bytes: friction, a tissue that remembers, waiting jaws.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1 here=$(realpath "$(dirname "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
source "$here/clamp_case.bash"

fail() { echo "$1" >&2; exit 1; }

clamp_case case "$bin"
sed -i 's/^speed.*/speed_mm_s = 1500\ngap_mm = 8\nfriction = 0.3/; s/^frames.*/frames = 5\nkinetic_part = 0.5/; s/^rows.*/rows = 100/' case.toml
cat >> case.toml <<'TOML'
[[effect]]
name = "prony"
g = 0.3
tau_s = 0.01
[[effect]]
name = "support"
stiffness = 0.001
box = { min_mm = [-20, -20, 20], max_mm = [20, 0, 40] }
friction = 0.3
TOML
solve() { exec "$bin/palpate-solve" case.toml "$1" --threads 1 </dev/null; }
bytes_of() { (cd "$1" && find . -type f -print0 | sort -z | xargs -0 sha256sum); }

start=$(date +%s%N)
(solve whole) >/dev/null 2>&1
nanoseconds=$(($(date +%s%N) - start))
bytes_of whole > whole.sums
[ ! -e whole/restart.bin ] || fail "the delivered folder holds restart.bin"

killed_at() {
  solve out >/dev/null 2>&1 &
  local pid=$!
  sleep "$(awk -v n=$nanoseconds -v p="$1" 'BEGIN { printf "%.3f", n * p / 1e11 }')"
  kill -9 $pid 2>/dev/null || true
  wait $pid 2>/dev/null || true
  rm -rf out out.card.json
}

resumed=0
for share in 20 "45 40" 80; do
  for percent in $share; do killed_at "$percent"; done
  (solve out) >/dev/null 2>message
  if grep -q "continues a run that was killed" message; then resumed=$((resumed + 1)); fi
  bytes_of out | cmp - whole.sums || fail "killed at $share %: other bytes"
  [ -z "$(find . -maxdepth 1 -name '.partial-*')" ] || fail "something temporary is left"
  rm -r out out.card.json
done
[ $resumed -ge 1 ] || fail "no run went on where it was"
echo "$resumed of 3 closings went on where they were"
