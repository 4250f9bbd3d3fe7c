# palpate-phantom: series that gdcminfo, dcm2niix and dciodvfy accept, in every orientation; truth that fits; same bytes on a rerun.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
data=$PWD/data/studies
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >axial.toml <<'TOML'
schema = "palpate-phantom/1"
[kidney]
[scan]
voxel_mm = [2.5, 2.5, 2.5]
supersampling = 3
TOML
cat >oblique.toml <<'TOML'
schema = "palpate-phantom/1"
title = "Lamb kidney, oblique: ünïcode"
[kidney]
length_mm = 60
width_mm = 35
thickness_mm = 25
[pose]
rotation_deg = [10, -25, 40]
centre_mm = [-31.7, 12.9, 140.3]
[scan]
plane = "coronal"
rotation_deg = [12, 7, -33]
voxel_mm = [1.1, 1.7, 2.9]
slice_thickness_mm = 4
margin_mm = 5
noise = 0.1
bias = 0.3
supersampling = 3
TOML
cat >colon.toml <<'TOML'
schema = "palpate-phantom/1"
[colon]
[scan]
row_direction = [0.6, 0.8, 0]
column_direction = [0, 0, -1]
voxel_mm = [3, 3, 3]
noise = 0.02
supersampling = 3
TOML

cat >uterus.toml <<'TOML'
schema = "palpate-phantom/1"
[uterus]
[pose]
rotation_deg = [5, 0, 15]
[scan]
plane = "sagittal"
voxel_mm = [2, 2, 2]
supersampling = 3
TOML

for spec in axial oblique colon uterus; do
  "$bin/palpate-phantom" $spec.toml $spec.dicom $spec.truth --quiet
  for slice in $spec.dicom/*; do
    dciodvfy "$slice" >said 2>&1 || true
    if grep -q '^Error' said || ! grep -q '^MRImage' said; then echo "dciodvfy refuses $slice:"; cat said; exit 1; fi
    gdcminfo "$slice" >said 2>&1
    if ! grep -q 'MediaStorage is 1.2.840.10008.5.1.4.1.1.4 ' said; then echo "gdcminfo refuses $slice:"; cat said; exit 1; fi
  done
  mkdir $spec.nii
  dcm2niix -z n -f scan -o $spec.nii $spec.dicom >said 2>&1
  if [ "$(ls $spec.nii/*.nii | wc -l)" != 1 ]; then echo "dcm2niix: not one volume"; cat said; exit 1; fi
  "$bin/palpate-import" $spec.dicom $spec.nii.gz --quiet
  "$bin/test-same-scan" $spec.nii.gz $spec.nii/scan.nii 0
  # The truth lies where the scan lies, and its labels hold the organ's volume to 3 % at these coarse voxels.
  python3 - $spec <<'PY'
import json, sys
card = json.load(open(sys.argv[1] + ".dicom.card.json"))
truth = json.load(open(sys.argv[1] + ".truth/truth.json"))
volume, labelled = truth["volume_mm3"], card["notes"]["labelled_mm3"]
parts = sum(p["volume_mm3"] for p in truth["parts"])
assert abs(labelled / volume - 1) <= 0.03, (labelled, volume)
assert abs(parts / volume - 1) <= 2e-3, (parts, volume)
assert all(c["pass"] for c in card["checks"])
imported = json.load(open(sys.argv[1] + ".nii.gz.card.json"))["notes"]
assert imported["size"] == truth["scan"]["size"]
assert all(abs(a - b) <= 1e-6 for a, b in zip(imported["voxel_mm"], truth["scan"]["voxel_mm"])), imported
PY
done
grep -q '"orientation": "oblique coronal"' oblique.nii.gz.card.json

# same bytes: rerun with another number of threads; other noise and other UIDs with another seed
"$bin/palpate-phantom" oblique.toml again.dicom again.truth --quiet --threads 1
diff -r oblique.dicom again.dicom
diff -r oblique.truth again.truth
"$bin/palpate-phantom" oblique.toml seed.dicom seed.truth --quiet --seed 7
diff -r oblique.truth seed.truth
if cmp -s oblique.dicom/IM_0005.dcm seed.dicom/IM_0005.dcm; then echo "the seed changes nothing"; exit 1; fi

# refused LINES WORD: a spec of these lines ends with exit code 2, the word in the message, and nothing left behind
refused() {
  local got=0
  printf 'schema = "palpate-phantom/1"\n%b\n' "$1" >bad.toml
  "$bin/palpate-phantom" bad.toml bad.dicom bad.truth --quiet 2>message || got=$?
  if [ $got != 2 ] || ! grep -q -- "$2" message; then echo "expected exit code 2 and \"$2\", got $got and:"; cat message; exit 1; fi
  if ls -d .*partial* bad.dicom* bad.truth* 2>/dev/null; then echo "left something behind"; exit 1; fi
}
refused '[kidney]\nlenght_mm = 60' length_mm
refused '[kidney]\nlength_mm = -60' 'out of range'
refused '[kidney]\nlength_mm = nan' 'finite'
refused '[kidney]\nlength_mm = 60\nwidth_mm = 60' '1.2 times its width'
refused '[kidney]\n[colon]' 'one organ'
refused '' 'one organ'
refused '[colon]\ncentreline_mm = [[0,0,0],[50,0,0],[50,5,0],[0,5,0]]' 'meets itself'
refused '[colon]\ncentreline_mm = [[0,0],[50,0,0]]' 'list of points'
refused '[uterus]\ntube_length_mm = 30' 'too short to reach over the ovary'
refused '[uterus]\novary_length_mm = 0' 'arches over an ovary'
refused '[uterus]\n[colon]' 'one organ'
refused '[kidney]\n[scan]\nvoxel_mm = [1, 0, 1]' voxel_mm
refused '[kidney]\n[scan]\nvoxel_mm = [0.05, 0.05, 0.05]' 'too many voxels'
refused '[kidney]\n[scan]\nrow_direction = [1, 1, 0]' 'right angles'
refused '[kidney]\n[scan]\nplane = "axail"' axial

# the specs of the studies at hand can be read (coarser, to be quick)
for study in kidney_indentation lamb_kidney colon_phantom uterine_palpation tubal_mobility; do
  sed 's/^voxel_mm.*/voxel_mm = [4, 4, 4]/' "$data/$study/phantom.toml" >study.toml
  "$bin/palpate-phantom" study.toml study.dicom study.truth --quiet --force
done
echo "phantom: good"
