#!/usr/bin/env bash
# What the loop finds by its quick model it puts to the solver: a hidden relaxation changes the force there within a tenth as the quick model says, over loading, hold and unloading; a stiffer law, which has
# one force at each depth, is solved going in only, and is kept.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 bench/hidden/make.py --protocol short --effect prony --seed 4 "$folder/set"
"$bin/palpate-loop" run "$folder/set/set.toml" "$folder/loop" --quiet --null-sets 200 >/dev/null
test ! -e "$folder/loop/confirmation"
python3 - "$folder/loop/report.json" <<'P'
import json, sys
report = json.load(open(sys.argv[1]))
told = report["confirmed_in_solver"]
print(told)
assert report["verdict"]["effects"] == told["effects"] == ["prony"] and told["confirmed"], told
assert abs(told["solver_over_shortcut"] - 1) <= 0.1 and told["apart"] <= 0.1 and report["solves"] == 2, told
assert any("confirmed in the solver" in remark for remark in report["remarks"]), report["remarks"]
P
python3 bench/hidden/make.py --protocol short --effect stiffening --size 10 --seed 4 "$folder/stiff"
for again in 1 2; do "$bin/palpate-loop" run "$folder/stiff/set.toml" "$folder/stiffer" --quiet --null-sets 200 --solves "$folder/kept" --force >/dev/null; done
python3 - "$folder/stiffer/report.json" "$folder"/kept/confirmation/*/result/history.csv <<'P'
import csv, json, sys
told = json.load(open(sys.argv[1]))["confirmed_in_solver"]
print(told)
assert told["effects"] == ["stiffening"] and told["confirmed"] and told["apart"] <= 0.1, told
assert len(sys.argv) == 4, "solved again"
for history in sys.argv[2:]:
    depths = [float(row["depth[mm]"]) for row in csv.DictReader(open(history))]
    assert depths == sorted(depths) and len(depths) == 15, depths
P
