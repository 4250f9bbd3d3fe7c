#!/usr/bin/env bash
# The phantom kidney (1 mm voxels, 5 % noise) from series to tetrahedra against its exact truth: Dice ≥ 0.97, volume within 2 %, mean
# distance of the surface ≤ 0.3 mm, smallest dihedral angle ≥ 8°, every check of every card.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The demo's study without its solves and its page.
mkdir "$folder/study"
cp data/studies/kidney_indentation/phantom.toml "$folder/study/"
awk '/^\[\[solve\]\]/ || /^\[report\]/ {exit} {print}' data/studies/kidney_indentation/study.toml >"$folder/study/study.toml"
"$bin/palpate" run "$folder/study/study.toml" --quiet
result=$folder/study/result

read -r distance _ < <("$bin/test-surface-distance" "$result/surface.vtp" "$result/truth/surface.vtp")
overlap=$("$bin/test-overlap" "$result/labels.nii.gz" "$result/truth/labels.nii.gz")
python3 - "$result" "$distance" "$overlap" <<'PY'
import json, pathlib, sys
result, distance = pathlib.Path(sys.argv[1]), float(sys.argv[2])
dice = float(sys.argv[3].split()[0])
truth = json.loads((result / "truth/truth.json").read_text())["volume_mm3"]
ledger = {c["name"]: c["value"] for c in json.loads((result / "mesh.vtu.card.json").read_text())["checks"]}
volume = json.loads((result / "mesh.vtu.card.json").read_text())["notes"]["volume_mm3"] / truth
angle = ledger["smallest dihedral angle"]
print(f"Dice {dice:.5f}, mesh volume over truth {volume:.5f}, mean surface distance {distance:.4f} mm, smallest dihedral angle {angle:.2f} deg")
failed = [c["name"] for card in result.glob("*.card.json") for c in json.loads(card.read_text())["checks"] if not c["pass"]]
assert not failed, failed
assert dice >= 0.97 and abs(volume - 1) <= 0.02 and distance <= 0.3 and angle >= 8 and ledger["inverted tetrahedra"] == 0
PY
