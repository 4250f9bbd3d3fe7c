# palpate-mesh: good surfaces become meshes that pass every check, bad ones are refused with a place; same bytes on a rerun.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$bin/test-shapes" .

# refused CODE WORD ARGUMENTS...: the exit code, a word of the message, and nothing left behind
refused() {
  local code=$1 word=$2 got=0
  shift 2
  "$bin/palpate-mesh" "$@" --quiet 2>message || got=$?
  if [ "$got" != "$code" ] || ! grep -q -- "$word" message; then
    echo "expected exit code $code and \"$word\", got $got and:"; cat message; exit 1
  fi
  if ls .partial-* bad.vtu bad.vtu.card.json 2>/dev/null; then echo "left something behind"; exit 1; fi
}

for shape in ball bean torus two hollow stone; do
  "$bin/palpate-mesh" $shape.vtp $shape.vtu --quiet
  if grep -q '"pass": false' $shape.vtu.card.json; then echo "$shape: a check failed"; exit 1; fi
done

"$bin/palpate-mesh" bean.vtp again.vtu --quiet --threads 1
cmp bean.vtu again.vtu
"$bin/palpate-mesh" bean.vtp again.vtu --quiet --threads 2 --force
cmp bean.vtu again.vtu

# Fine near the focus, coarse elsewhere; same bytes again
focus="--edge=6 --focus=0,4,12.2 --focus-edge=1.5 --focus-radius=4 --grading=12"
"$bin/palpate-mesh" bean.vtp graded.vtu --quiet $focus
"$bin/palpate-mesh" bean.vtp again.vtu --quiet --force --threads 2 $focus
cmp graded.vtu again.vtu
"$bin/palpate-mesh" bean.vtp coarse.vtu --quiet --edge=6
# notes NAME KEY: a number of a mesh's card
notes() { python3 -c 'import json, sys; print(json.load(open(sys.argv[1] + ".vtu.card.json"))["notes"][sys.argv[2]])' "$1" "$2"; }
python3 - "$(notes graded nodes)" "$(notes coarse nodes)" "$(notes bean nodes)" <<'PY'
import sys
graded, coarse, uniform = map(float, sys.argv[1:])
if not (coarse < graded < uniform): sys.exit(f"nodes: coarse {coarse}, graded {graded}, uniform {uniform}")
PY

refused 4 "surface is open" open.vtp bad.vtu
refused 4 "inside out" inside_out.vtp bad.vtu
refused 4 "same region" doubled.vtp bad.vtu
refused 4 "where: near (.*) mm" crossing.vtp bad.vtu
refused 2 "too long" ball.vtp bad.vtu --edge 50
refused 6 "million tetrahedra" ball.vtp bad.vtu --edge 0.01
refused 2 "away from the surface" ball.vtp bad.vtu --focus 80,0,0
refused 3 "" message bad.vtu
refused 4 "dihedral" ball.vtp bad.vtu --min-dihedral 40

# kill -9 leaves no mesh, and the next run nothing of the killed one
"$bin/palpate-mesh" bean.vtp killed.vtu --quiet --edge=1.2 & running=$!
sleep 0.3
kill -KILL $running 2>/dev/null
wait $running 2>/dev/null || true
[ ! -e killed.vtu ] || { echo "killed, and yet there is a mesh"; exit 1; }
"$bin/palpate-mesh" bean.vtp killed.vtu --quiet
if ls .partial-* 2>/dev/null; then echo "the killed run's leftovers were not removed"; exit 1; fi
