#!/usr/bin/env bash
# Bad input: each kind has its own message and exit code, and leaves nothing behind.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
source tests/every/small_study/stages.bash
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
make_small_study "$bin" "$folder/my study" 2>/dev/null
cd "$folder"
result="my study/result"
mkdir out
: >messages

# refused <code> <regular expression> <program and arguments>: outputs go to out/, which stays empty; no two kinds say the same.
refused() {
  local code=$1 words=$2 got=0
  shift 2
  "$bin/$1" "${@:2}" --quiet </dev/null >stdout 2>message || got=$?
  if [ $got -ne "$code" ] || ! grep -qE -e "$words" message; then
    echo "expected exit code $code and \"$words\" of $*, got $got and:" >&2
    cat message >&2
    exit 1
  fi
  [ -z "$(find out -mindepth 1)" ] || { echo "$* left behind: $(find out -mindepth 1)" >&2; exit 1; }
  if find . -name '.partial-*' | grep .; then echo "$* left something temporary" >&2; exit 1; fi
  head -n 1 message >>messages
}

mkdir empty texts "two series"
refused 3 "folder is empty" palpate-import empty out/scan.nii.gz
echo "a letter" >texts/letter.txt
echo "a list" >texts/list.txt
refused 3 "no DICOM file" palpate-import texts out/scan.nii.gz
refused 3 "no such folder" palpate-import nowhere out/scan.nii.gz

mapfile -t slices < <(ls "$result/dicom")
slice=${slices[4]}
for share in 25 50 90; do
  rm -rf cut
  cp -r "$result/dicom" cut
  truncate -s $(($(stat -c %s "cut/$slice") * share / 100)) "cut/$slice"
  refused 3 "truncated" palpate-import cut out/scan.nii.gz
  grep -qF "$slice" message || { echo "the truncated slice is not named" >&2; exit 1; }
done
sort -u messages -o messages  # the same kind three times

cp -r "$result/dicom" gap
rm "gap/$slice"
refused 4 "gap of 5\.0+ mm" palpate-import gap out/scan.nii.gz  # slices lie 2.5 mm apart

sed 's/^noise = .*/noise = 0.02/' "$small_study/phantom.toml" >other.toml
"$bin/palpate-phantom" other.toml other other-truth --quiet
for file in "${slices[@]}"; do
  cp "$result/dicom/$file" "two series/a-$file"
  cp "other/$file" "two series/b-$file"
done
refused 2 "2 series" palpate-import "two series" out/scan.nii.gz
[ "$(grep -c 'uid 2\.25\.' message)" -eq 2 ] || { echo "the two series are not listed" >&2; exit 1; }

refused 2 "outside the scan" palpate-segment "$result/scan.nii.gz" out/labels.nii.gz --seeds 1000,0,0
refused 4 "nothing found" palpate-segment "$result/scan.nii.gz" out/labels.nii.gz --threshold-lower 100000
head -c 5000 "$result/scan.nii.gz" >scan.nii.gz
refused 3 "truncated or damaged" palpate-segment scan.nii.gz out/labels.nii.gz

"$bin/test-surface-shapes" .
refused 4 "hole that cannot be closed" palpate-surface large_hole.vtp out/surface.vtp
refused 4 "surface is open" palpate-mesh large_hole.vtp out/mesh.vtu
head -c 5000 "$result/mesh.vtu" >mesh.vtu
refused 3 "truncated: the end" palpate-solve "my study/soft.toml" out/soft --mesh mesh.vtu

sed 's/^aim_mm = .*/aim_mm = [300.0, 0.0, 0.0]/' "my study/soft.toml" >miss.toml
refused 2 "misses the organ" palpate-solve miss.toml out/soft --mesh "$result/mesh.vtu"
sed 's/^radius_mm/radius_m/' "my study/soft.toml" >misspelt.toml
refused 2 "radius_mm" palpate-solve misspelt.toml out/soft --mesh "$result/mesh.vtu"
grep -q "misspelt.toml:[0-9]" message || { echo "the line of the misspelt key is not named" >&2; exit 1; }
sed 's/^count = 3/cuont = 3/' "my study/soft.toml" >misspelt.toml
refused 2 "did you mean count" palpate-solve misspelt.toml out/soft --mesh "$result/mesh.vtu"
sed 's/^law = .*/law = "neo_hokean"/' "my study/soft.toml" >misspelt.toml
refused 2 "neo_hookean" palpate-solve misspelt.toml out/soft --mesh "$result/mesh.vtu"

[ -z "$(sort messages | uniq -d)" ] || { echo "two kinds of bad input say the same: $(sort messages | uniq -d)" >&2; exit 1; }
