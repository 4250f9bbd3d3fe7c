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

for shape in ball two hollow stone; do
  "$bin/palpate-mesh" $shape.vtp $shape.vtu --quiet
  if grep -q '"pass": false' $shape.vtu.card.json; then echo "$shape: a check failed"; exit 1; fi
done

"$bin/palpate-mesh" ball.vtp again.vtu --quiet --threads 1
cmp ball.vtu again.vtu
"$bin/palpate-mesh" ball.vtp again.vtu --quiet --threads 2 --force
cmp ball.vtu again.vtu

refused 4 "surface is open" open.vtp bad.vtu
refused 4 "inside out" inside_out.vtp bad.vtu
refused 4 "same region" doubled.vtp bad.vtu
refused 4 "ntersect" crossing.vtp bad.vtu
refused 2 "too long" ball.vtp bad.vtu --edge 50
refused 6 "million tetrahedra" ball.vtp bad.vtu --edge 0.01
refused 2 "away from the surface" ball.vtp bad.vtu --focus 80,0,0
refused 3 "" message bad.vtu
refused 4 "dihedral" ball.vtp bad.vtu --min-dihedral 40
