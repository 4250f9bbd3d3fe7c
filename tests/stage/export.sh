#!/usr/bin/env bash
# palpate-export: what the file for CalculiX holds, that CalculiX reads and solves it for every law, and what is refused.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
source tests/stage/patch_force.bash
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() { echo "$1" >&2; exit 1; }

# refused <code> <words>: the case with one change is refused with these words and leaves nothing.
refused() {
  local code=0
  "$bin/palpate-export" "$folder/case.toml" "$folder/no.inp" --mesh "$folder/mesh.vtu" --quiet 2>"$folder/err" || code=$?
  [ $code -eq "$1" ] || fail "exit code $code, not $1: $(cat "$folder/err")"
  grep -qF -e "$2" "$folder/err" || fail "does not say \"$2\": $(cat "$folder/err")"
  grep -qE 'case.toml:[0-9]+' "$folder/err" || fail "no line is named: $(cat "$folder/err")"
  [ ! -e "$folder/no.inp" ] || fail "something is left"
}

# Four cells across and three deep: 5² · 4 corners, a node on each of its edges, 9² of them on the top and 9² on the bottom.
"$bin/test-block" "$folder/mesh.vtu" 6 2 0 3 20
write_case neo_hookean incompressible 4 20 >"$folder/case.toml"
"$bin/palpate-export" "$folder/case.toml" "$folder/model.inp" --mesh "$folder/mesh.vtu" --quiet
awk '
  /^\*/ { block = $0; next }
  block ~ /^\*NODE, / { ++nodes }
  block ~ /^\*ELEMENT/ { ++tets; if (NF != 11) exit 1 }
  block ~ /^\*BOUNDARY/ { ++held[block] }
  length($0) > 132 { print "a line is too long: " $0; exit 1 }
  { for (i = 1; i <= NF; ++i) if (length($i) > 21) { print "a number is too long: " $i; exit 1 } }
  END {
    print nodes " nodes, " tets " tetrahedra"
    if (nodes != 9 * 9 * 7 || tets != 4 * 4 * 3 * 6) exit 1
    for (block in held) if (held[block] != 3 * 9 * 9) { print block " has " held[block] " lines"; exit 1 }
  }' "$folder/model.inp" || fail "the file is not as it should be"
grep -qxF '0.00335, 0.298507462687' "$folder/model.inp" || fail "C10 is not mu/2, or D1 not 2/(1000 mu)"
grep -q incompressible "$folder/model.inp.card.json" || fail "the card does not warn of compressibility"

cp "$folder/case.toml" "$folder/good.toml"
for table in tool force spring gravity; do
  case $table in
    tool) lines='kind = "ball"\nradius_mm = 5.0\naim_mm = [0.0, 0.0, 20.0]\naxis = [0.0, 0.0, -1.0]\ndepth_mm = 1.0' ;;
    force) lines='box = { min_mm = [-21, -21, 19], max_mm = [21, 21, 21] }\ntotal_N = [0.0, 0.0, 1.0]' ;;
    spring) lines='box = { min_mm = [-21, -21, -1], max_mm = [21, 21, 1] }\nstiffness_N_mm3 = 0.001' ;;
    gravity) lines='direction = [0.0, 0.0, -1.0]' ;;
  esac
  { cat "$folder/good.toml"; printf "[$table]\n$lines\n"; } >"$folder/case.toml"
  refused 6 "cannot say [$table]"
done
sed 's/^law = .*/law = "fung_demiray"\nb = 1.0/' "$folder/good.toml" >"$folder/case.toml"
refused 6 'cannot say law = "fung_demiray"'

command -v ccx >/dev/null || { echo "SKIPPED: no ccx (Debian: calculix-ccx), so nothing read the files"; exit 0; }

# CalculiX solves each law to the end; the force on the patch is the one on the base (1e-4: its own tolerance). The mesh is too coarse for
# the size of a force to mean anything, but elements of higher order are softer: it lies between half of ours and ours.
for law in neo_hookean mooney_rivlin yeoh ogden; do
  write_case $law 100 8 20 >"$folder/case.toml"
  read -r their _ < <(theirs "$bin" "$folder" "$folder/mesh.vtu" 1)
  read -r our _ < <(ours "$bin" "$folder" "$folder/mesh.vtu" 1)
  base=$(awk '/total force.*BASE/ { getline; getline; force = $3 } END { print force }' "$folder/model.dat")
  echo "$law at 6 mm: $our N here, $their N by CalculiX, on its base $base N"
  awk -v o="$our" -v t="$their" -v b="$base" 'BEGIN { d = (t - b) / t; if (d < 0) d = -d; exit !(d <= 1e-4 && t > o / 2 && t < o) }' ||
    fail "$law: forces do not fit"
done
