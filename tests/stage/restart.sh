#!/usr/bin/env bash
# palpate-solve killed at any moment goes on where it was, to the same bytes; what a killed run left damaged, or of another case, is not used.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() { echo "$1" >&2; exit 1; }

# mesh.vtu: two blocks, one on the other with a gap of 0.05 mm: 12 × 12 × 6 mm in cells of 2 mm, 8 × 8 × 4 mm in cells of 1.6 mm and 2 mm.
# large.vtu: one block of
# 1 183 nodes, more than the size from which a factor is kept.
PYTHONPATH=$here python3 -B - <<'PY'
from two_blocks import block, write
block((-6, -6, 0), (12, 12, 6), (6, 6, 3), 1)
block((-4, -4, 6.05), (8, 8, 4), (5, 5, 2), 2)
write("mesh.vtu")
block((-6, -6, 0), (12, 12, 6), (12, 12, 6), 1)
write("large.vtu")
PY

# The upper block is dragged by a ball with friction: it presses and rubs the lower one, which yields with time and softens.
cat >case.toml <<'TOML'
schema = "palpate-case/1"
[[material]]
region = "lower"
law = "neo_hookean"
mu = 0.005
[[material]]
region = "upper"
law = "neo_hookean"
mu = 0.01
[[effect]]
name = "prony"
g = [0.3]
tau_s = [0.5]
[[effect]]
name = "mullins"
inverse_r = 0.5
m = 0.0005
[[contact]]
between = ["lower", "upper"]
friction = 0.3
[base]
plane = { point_mm = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }
[[spring]]
label = "upper_surface"
stiffness_N_mm3 = 0.0001
[gravity]
direction = [0.0, 0.0, -1.0]
steps = 2
[[tool]]
kind = "ball"
radius_mm = 3.0
aim_mm = [0.5, 0.0, 10.0]
axis = [0.1, 0.0, -1.0]
friction = 0.4
path = [[0, 0], [0.6, 1.6], [1.0, 1.2]]
[steps]
count = 20
frames = 4
TOML
mesh=mesh.vtu
solve() { exec "$bin/palpate-solve" "$1" "$2" --mesh $mesh --threads 1 --sensitivities "material[0].mu, effect[0].g[0]" </dev/null; }
bytes_of() { (cd "$1" && find . -type f -print0 | sort -z | xargs -0 sha256sum); }

start=$(date +%s%N)
(solve case.toml whole) >/dev/null
nanoseconds=$(($(date +%s%N) - start))
bytes_of whole >whole.sums
[ ! -e whole/restart.bin ] || fail "the delivered folder holds restart.bin"

# killed_at <per cent> <case>: out/ unfinished; where it was done before, there is nothing.
killed_at() {
  solve "$2" out >/dev/null 2>&1 &
  local pid=$!
  sleep "$(awk -v n=$nanoseconds -v p="$1" 'BEGIN { printf "%.3f", n * p / 1e11 }')"
  kill -9 $pid 2>/dev/null || true
  wait $pid 2>/dev/null || true
  rm -rf out out.card.json
}

# killed_midway <case>: out/ unfinished, with two frames and a restart file that knows of them (quick steps are not all written). A run that
# is done before it is seen there is begun again.
killed_midway() {
  local pid
  for _ in 1 2 3 4 5; do
    rm -rf out out.card.json
    solve "$1" out >/dev/null 2>&1 &
    pid=$!
    while kill -0 $pid 2>/dev/null; do
      if [ -f .partial-$pid-out/frames/frame_0001.vtu ] && [ .partial-$pid-out/restart.bin -nt .partial-$pid-out/frames/frame_0001.vtu ]; then
        kill -9 $pid 2>/dev/null || break
        wait $pid 2>/dev/null || true
        [ -e out ] || return 0
        break
      fi
      sleep 0.02
    done
    wait $pid 2>/dev/null || true
  done
  fail "five runs ended before they could be killed"
}
left() { find . -maxdepth 1 -name '.partial-*-out'; }

# Six moments by the clock: whatever was written by then, the bytes are the same.
resumed=0
for share in 12 35 "30 25" 55 70 85; do
  for percent in $share; do killed_at "$percent" case.toml; done
  (solve case.toml out) >/dev/null 2>message
  if grep -q "continues a run that was killed" message; then resumed=$((resumed + 1)); fi
  bytes_of out | cmp - whole.sums || fail "killed at $share %: other bytes"
  [ -z "$(left)" ] || fail "something temporary is left"
  rm -r out out.card.json
done
echo "$resumed of 6 runs went on where they were"

# Untouched, it is used. Damaged (one byte of the file, one of a frame; cut short), or of another case: nothing of it is.
for damage in none byte frame cut case; do
  killed_midway case.toml
  file=$(left)/restart.bin
  [ -f "$file" ] || fail "no restart file midway"
  case $damage in
    none) ;;
    byte) printf 'x' | dd of="$file" bs=1 seek=$(($(stat -c %s "$file") / 2)) conv=notrunc 2>/dev/null ;;
    frame) printf 'x' | dd of="$(left)/frames/frame_0000.vtu" bs=1 seek=2000 conv=notrunc 2>/dev/null ;;
    cut) truncate -s -1 "$file" ;;
    case) sed -i 's/^friction = 0.4$/friction = 0.40/' case.toml ;;
  esac
  (solve case.toml out) >/dev/null 2>message
  said="starts from the beginning"
  if [ $damage = none ]; then said="continues a run that was killed"; fi
  grep -q "$said" message || fail "$damage: does not say that it $said: $(cat message)"
  bytes_of out | cmp - whole.sums || fail "$damage: other bytes"
  rm -r out out.card.json
done

# Large enough that Newton's equations are solved with a factor of before (decision 036): it goes on with that one, and what it has cost.
cat >large.toml <<'TOML'
schema = "palpate-case/1"
[[material]]
law = "neo_hookean"
mu = 0.005
[[effect]]
name = "prony"
g = [0.3]
tau_s = [0.5]
[base]
plane = { point_mm = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }
[tool]
kind = "ball"
radius_mm = 3.0
aim_mm = [0.1, 0.2, 6.0]
axis = [0.0, 0.0, -1.0]
friction = 0.3
depth_mm = 1.2
[steps]
count = 24
frames = 6
TOML
mesh=large.vtu
(solve large.toml large) >/dev/null
bytes_of large >large.sums
killed_midway large.toml
(solve large.toml out) >/dev/null 2>message
grep -q "continues a run that was killed" message || fail "large: does not go on: $(cat message)"
bytes_of out | cmp - large.sums || fail "large: other bytes"
