#!/usr/bin/env bash
# The 2005 paper's Fig. 3 continued: Hooke, then the exponential law, then what is still missing. Two sets of one kidney whose law is left open: with a hidden viscosity, and with a hidden capsule.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$(realpath "$1") out=$(realpath -m "$2")   # the executables; a folder that is made
here=$(cd "$(dirname "$0")" && pwd)
repository=$(realpath "$here/../../../..")
mkdir -p "$out" && cd "$out"
cp "$here/../phantom.toml" .
sed 's/^edge = 4.5/edge = 2.2/; s/^focus_edge = .*/focus_edge = 0.9/; s/^edge = 7.0/edge = 5.0/' "$here/../coarse.toml" >study.toml
"$bin/palpate" run study.toml --quiet
mkdir -p organ && cp result/mesh.vtu organ/
sed 's/^schema.*/&\nmesh = "mesh.vtu"/' "$here/../fung_demiray.toml" >organ/case.toml
"$bin/palpate-mesh" result/surface.vtp truth.vtu --edge 5.5 --focus 6.5,-12.1,0 --focus-edge 0.45 --focus-radius 2.7 --quiet
"$bin/palpate-mesh" result/surface.vtp memory.vtu --edge 6 --focus 6.5,-12.1,0 --focus-edge 0.7 --focus-radius 3 --quiet
python3 "$repository/bench/hidden/solved.py" "$bin" organ/case.toml truth.vtu truths sets --memory-mesh memory.vtu --effects prony,capsule --law unknown --seed 41
for set in prony capsule; do
  "$bin/palpate-loop" run "sets/${set}_0/set.toml" "$set" --solves solves
  "$bin/palpate-report" "$set" "$set.html"
done
