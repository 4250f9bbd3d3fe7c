# The studies on scans from a scanner: each runs with one palpate run, and every check of every card passes.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
scans=${PALPATE_SHARED_DATA:-../shared/data}/scans
if [ ! -d "$scans" ]; then echo "SKIPPED: no scans at $scans"; exit 0; fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# run STUDY SERIES: the study on that folder, wherever the shared data lies
run() {
  "$bin/palpate" run "data/studies/$1/study.toml" --dicom "$scans/$2/series" --out "$folder/$1"
  for output in scan.nii.gz labels.nii.gz surface.vtp mesh.vtu; do
    if ! grep -q '"pass": true' "$folder/$1/$output.card.json"; then echo "$1: no check passed in $output"; exit 1; fi
    if grep -B4 -A2 '"pass": false' "$folder/$1/$output.card.json"; then echo "$1: a check failed in $output"; exit 1; fi
  done
  grep -q '"warnings": \[\]' "$folder/$1/labels.nii.gz.card.json" || { echo "$1: the label touches the border"; exit 1; }
}

run mouse_kidney mouse_abdomen_mr
run colon_lumen lower_torso_ct
