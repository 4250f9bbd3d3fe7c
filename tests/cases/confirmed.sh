#!/usr/bin/env bash
# What the loop finds by its quick model it puts to the solver: a hidden relaxation changes the force there within a tenth as the quick model says, over loading, hold and unloading.
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
