#!/usr/bin/env bash
# The ten kidney label maps of kits19 through palpate-surface and palpate-mesh: time, triangles, volumes, angles. Numbers kept, not asserted.
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: bench/quality/kits19.sh BIN [CASE...]
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
bin=$(cd "${1:-$root/build/release/bin}" && pwd)
shift || true
masks=${PALPATE_SHARED_DATA:-$root/../shared/data}/masks/kits19_kidneys
if [ ! -d "$masks" ]; then echo "SKIPPED: no $masks"; exit 0; fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cases=("$@")
[ $# -gt 0 ] || cases=($(cd "$masks" && ls -d case_*))

echo "case | surface s | triangles | voxels mm3 | final/voxels | genus | min angle | min fold | tries | mesh s | tets | min dihedral"
passed=0
for case in "${cases[@]}"; do
  surface=$folder/$case.vtp mesh=$folder/$case.vtu
  if ! "$bin/palpate-surface" "$masks/$case/segmentation.nii.gz" "$surface" --quiet 2>"$folder/message"; then
    echo "$case | surface stopped: $(tr '\n' ' ' <"$folder/message")"; continue
  fi
  meshed=yes
  "$bin/palpate-mesh" "$surface" "$mesh" --quiet 2>"$folder/message" || meshed=no
  python3 - "$case" "$surface.card.json" "$mesh.card.json" "$meshed" <<'P'
import json, sys
case, surface, mesh, meshed = sys.argv[1:]
card = json.load(open(surface))
notes, checks = card["notes"], {c["name"]: c["value"] for c in card["checks"]}
volumes, angles = notes["volume_ledger"], notes["angles_deg"]
row = [case, f'{card["seconds"]:.1f}', notes["triangles"], f'{volumes["voxels_mm3"]:.0f}', f'{1 + volumes["final_against_voxels"]:.4f}',
       checks["genus"], f'{angles["smallest"]:.1f}', f'{angles["sharpest_fold"]:.1f}', 1 + sum("tried again" in w for w in card["warnings"])]
if meshed == "yes":
    card = json.load(open(mesh))
    dihedral = [c["value"] for c in card["checks"] if "dihedral" in c["name"]]
    row += [f'{card["seconds"]:.1f}', card["notes"].get("tets", "-"), f"{min(dihedral):.1f}" if dihedral else "-"]
print(" | ".join(map(str, row)))
P
  if [ $meshed = yes ]; then passed=$((passed + 1)); else echo "$case | mesh stopped: $(tr '\n' ' ' <"$folder/message")"; fi
done
echo "$passed of ${#cases[@]} surfaces meshed"
[ "$passed" = "${#cases[@]}" ] || [ $# -eq 0 ]
