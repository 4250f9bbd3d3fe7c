#!/usr/bin/env bash
# A cylinder of 20 mm radius and height: what its sides take of the force, as the loop solves it, against GetFEM (bench/hidden/curves.csv): within 1 % of the force.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 bench/hidden/make.py --protocol ramp --radius 20 --seed 1 "$folder/set"
"$bin/palpate-loop" run "$folder/set/set.toml" "$folder/loop" --quiet --null-sets 200 >/dev/null
python3 - "$folder/loop/report.json" <<'P'
import csv, json, sys
site, = json.load(open(sys.argv[1]))["solved_curves"]
force = {(r["effect"], r["amplitude"], r["radius[mm]"], float(r["depth[mm]"])): float(r["force[N]"]) for r in csv.DictReader(open("bench/hidden/curves.csv"))}
for depth in (0.46, 1.15, 2.3, 3.818):
    x = depth / site["deepest_mm"]
    ours, theirs = sum(c * x**k for k, c in enumerate(site["solved_over_closed"])), force["narrow", "20", "5.0", depth] / force["none", "0", "5.0", depth]
    print(f"{depth} mm: {ours:.4f}, GetFEM {theirs:.4f}")
    assert abs(ours - theirs) <= 0.01 and theirs < 0.985, (depth, ours, theirs)
P
