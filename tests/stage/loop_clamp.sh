#!/usr/bin/env bash
# palpate-loop on a clamp: what a set of closings must say, in words.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 - <<'P'
import math
text = ('schema = "palpate-set/1"\n[specimen]\nid = "tube"\nshape = "tube"\ndiameter_mm = 25.0\nlength_mm = 30.0\nwall_mm = 1.2\nedge_mm = 3.4\nlaw = "neo_hookean"\n'
        '[tool.jaws]\nkind = "jaws"\nwidth_mm = 40.0\nlength_mm = 10.0\n')
for k in (1, 2):
    with open(f"r{k}.csv", "w") as out:
        out.write("t[s],u[mm],F[N]\n")
        for i in range(60):
            u = 12 * math.sin(math.pi * i / 59)
            out.write(f"{i / 10},{u:.4f},{0.05 * u + 1e-4 * math.sin(7 * i + k):.6f}\n")
    text += f'[[run]]\nid = "r{k}"\nfile = "r{k}.csv"\ntest = "clamp"\npoint_mm = [0, 0, 15]\nreplicate = "g"\nrole = "fit"\n'
open("set.toml", "w").write(text)
P
"$bin/palpate-loop" check set.toml | grep -q '^sound: 2 runs' || { echo "a sound set is not called sound" >&2; exit 1; }
# refused CODE WORDS SED: the set changed so
refused() {
  local got=0
  sed "$3" set.toml >bad.toml
  "$bin/palpate-loop" check bad.toml >/dev/null 2>message || got=$?
  if [ "$got" != "$1" ] || ! tr '\n' ' ' <message | grep -qE -- "$2"; then echo "expected $1 and \"$2\", got $got and:"; cat message; exit 1; fi
}
refused 2 'clamp closes on a tube' 's/^test = .*/test = "uniaxial"/'
refused 2 'wall_mm' 's/^wall_mm = .*/wall_mm = 9.0/'
refused 4 'jaws miss the tube' 's/15\]/45]/'
refused 4 'less than twice the declared wall' 's/^diameter_mm.*/diameter_mm = 14.0/'
refused 2 'ends' 's/^edge_mm.*/&\nends = "glued"/'

# How the tube is held reaches the solver: the first case that is written says so; nothing else of this run is waited for.
case_with() {
  sed "$1" set.toml >held.toml
  rm -rf kept out
  "$bin/palpate-loop" run held.toml out --solves kept --quiet >/dev/null 2>&1 &
  local pid=$!
  for _ in $(seq 300); do
    [ -z "$(find kept -name case.toml -size +0 2>/dev/null)" ] || break
    sleep 0.1
  done
  sleep 0.2
  kill -9 $pid 2>/dev/null || true
  wait $pid 2>/dev/null || true
  cat "$(find kept -name case.toml -print -quit)"
}
case_with 's/^edge_mm.*/&\nends = "fixed"/' | grep -qx 'ends = "fixed"' || { echo "the case does not say that the tube is held" >&2; exit 1; }
if case_with '' | grep -q '^ends'; then echo "a tube that is not held is said to be" >&2; exit 1; fi
# The curve is that of walls whose folds are finer than they are thick: 0.36 of 1.2 mm, and 0.8 of that on the finest mesh, which is the first.
case_with '' | grep -q 'in the folds 0.3456 mm' || { echo "the curve's folds are not fine" >&2; exit 1; }
