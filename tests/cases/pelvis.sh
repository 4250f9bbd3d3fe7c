#!/usr/bin/env bash
# The studies uterine_palpation and tubal_mobility, coarse and shorter, from series to result: a rod that slides drags by its friction alone, and an
# ovary that is lifted meets the tube.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r data/studies/uterine_palpation/*.toml "$folder"
mkdir "$folder/tube"
cp -r data/studies/tubal_mobility/*.toml "$folder/tube"
cd "$folder"

# --- a uterus: 3 mm deep, 5 mm sideways and back, with and without friction
sed -i 's/^voxel_mm.*/voxel_mm = [2, 2, 2]\nsupersampling = 3/' phantom.toml
sed -i '/^\[report\]/d; s/^edge = 5.0/edge = 9.0/; s/^edge = 4.0/edge = 6.0/; s/^focus_edge.*/focus_edge = 3.5/' study.toml
sed -i 's/^path = .*/path = [[0, 0], [3, 3], [13, 3]]/; s/path = \[\[0, 0\], \[6, 0\], \[11, 4.8\], \[16, 0\]\]/path = [[0, 0], [3, 0], [8, 2.4], [13, 0]]/; s/^count = 32/count = 13\nframes = 1/' press_and_slide.toml
"$bin/palpate" run study.toml --threads 1 --quiet
sed 's/^friction = 0.2/friction = 0/' press_and_slide.toml >smooth.toml
cmp -s smooth.toml press_and_slide.toml && { echo "no friction to leave out"; exit 1; }
"$bin/palpate-solve" smooth.toml smooth --mesh result/mesh.vtu --threads 1 --quiet
python3 - result/solve/press_and_slide smooth <<'PY'
import csv, json, sys
rough, smooth = ([{k: float(v) for k, v in row.items()} for row in csv.DictReader(open(f"{folder}/history.csv"))] for folder in sys.argv[1:])
for folder in sys.argv[1:]:
    facts = json.load(open(f"{folder}/summary.json"))
    assert facts["worst_force_imbalance"] <= 1e-3, facts["worst_force_imbalance"]
    assert facts["worst_penetration_of_element_size"] <= 0.01, facts["worst_penetration_of_element_size"]
at = {round(row["t[s]"]): i for i, row in enumerate(rough)}
there, back = at[3], at[13]
slid = smooth[back]["F[N]"] / smooth[there]["F[N]"] - 1
print(f"no friction: {smooth[there]['F[N]']:.4f} N before, {100 * slid:+.4f} % after sliding there and back")
assert abs(slid) <= 1e-4  # a state without memory; Newton's tolerance
up, down = at[6], at[10]  # the same place on the way there and back
drag = (rough[up]["Fz[N]"] - rough[down]["Fz[N]"]) / (rough[up]["F[N]"] + rough[down]["F[N]"])
print(f"friction 0.2: half the difference of the drag there and back is {drag:.3f} of the force")
assert 0.2 <= drag <= 0.35, drag  # at least mu; more as tissue bulges ahead of a tip that stands 3 mm deep
PY

# --- tube and ovary: lifted 7 mm, with and without contact between them
cd tube
sed -i 's/^\[scan\]/[scan]\nsupersampling = 2/' phantom.toml
sed -i '/^\[report\]/d; s/^edge = 5.0/edge = 8.0/; s/^focus_edge.*/focus_edge = 2.0/' study.toml
sed -i 's/^depth_mm = .*/depth_mm = 7.0/; s/^count = 16/count = 5\nframes = 1/' lift.toml
"$bin/palpate" run study.toml --threads 1 --quiet
sed '/^\[\[contact\]\]/d; /^between/d' lift.toml >apart.toml
"$bin/palpate-solve" apart.toml apart --mesh result/mesh.vtu --threads 1 --quiet
python3 - result/solve/lift apart <<'PY'
import csv, json, sys
facts = [json.load(open(f"{folder}/summary.json")) for folder in sys.argv[1:]]
for f in facts: assert f["worst_force_imbalance"] <= 1e-3, f["worst_force_imbalance"]
force = [f["final_force_N"] for f in facts]
lift = facts[0]["contacts"][0]["force_on_first_N"][2]
print(f"lift: {force[0]:.4f} N, of which {lift:.4f} N pass to the tube; without contact {force[1]:.4f} N")
assert lift >= 0.02 and force[0] - force[1] >= 0.3 * lift, (force, lift)
PY
echo "pelvis: good"
