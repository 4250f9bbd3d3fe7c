# palpate-import: what dcm2niix says, value by value and place by place; every codec; bad folders refused with nothing left behind.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
scans=${PALPATE_SHARED_DATA:-$PWD/../shared/data}/scans
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >spec.toml <<'TOML'
schema = "palpate-phantom/1"
title = "Left kidney"
[kidney]
[scan]
plane = "sagittal"
rotation_deg = [5, -8, 12]
voxel_mm = [3, 2.5, 4]
supersampling = 2
TOML
"$bin/palpate-phantom" spec.toml good truth --quiet
sed 's/Left kidney/Another one/' spec.toml >other.toml
"$bin/palpate-phantom" other.toml other truth2 --quiet
"$bin/palpate-import" good scan.nii.gz --quiet

fail() { echo "$1"; [ ! -f message ] || cat message; exit 1; }
# refused CODE WORD FOLDER [OPTION...]: the exit code, a word of the message, and nothing left behind
refused() {
  local code=$1 word=$2 got=0
  shift 2
  timeout 60 "$bin/palpate-import" "$1" bad.nii.gz "${@:2}" --quiet 2>message || got=$?
  if [ $got != "$code" ] || ! grep -q -- "$word" message; then fail "$1: expected exit code $code and \"$word\", got $got and:"; fi
  if ls -d .*partial* bad.nii.gz* 2>/dev/null; then fail "left something behind"; fi
}

# order of names, folders and foreign files do not matter, nor do threads
mkdir -p shuffled/a/b
i=0
for slice in $(ls good | sort -R --random-source=spec.toml); do
  i=$((i + 1))
  cp "good/$slice" "shuffled/$([ $((i % 2)) = 0 ] && echo a/b/)$i"
done
echo "not DICOM" >shuffled/a/notes.txt
"$bin/palpate-import" shuffled shuffled.nii.gz --quiet --threads 1
cmp scan.nii.gz shuffled.nii.gz
grep -q '"not_dicom": 1' shuffled.nii.gz.card.json

# several series
mkdir two && cp -r good other two
refused 2 'Another one' two
refused 2 'Left kidney' two --series 1         # both have number 1
refused 2 'no series is called' two --series nothing
for name in 'Left kidney' 'left KID' "$(sed -n 's/.*"uid": "\(.*\)".*/\1/p' scan.nii.gz.card.json)"; do
  "$bin/palpate-import" two chosen.nii.gz --series "$name" --quiet --force
  cmp scan.nii.gz chosen.nii.gz
done

# folders that cannot be read
mkdir empty text && echo words >text/a.txt
refused 3 'empty' empty
refused 3 '1 not DICOM' text
cp -r good truncated && head -c 3000 good/IM_0010.dcm >truncated/IM_0010.dcm
refused 3 'IM_0010.dcm' truncated
cp -r good header && head -c 700 good/IM_0011.dcm >header/IM_0011.dcm
refused 3 'IM_0011.dcm' header
cp good/IM_0011.dcm header/IM_0011.dcm && last=$(ls good | tail -1) && head -c 300 "good/$last" >"header/$last"
refused 3 "$last" header  # at the end of the series no gap would tell

# grids that are not regular: 4 mm pitch, so a missing slice leaves 8 mm
cp -r good missing && rm missing/IM_0009.dcm
refused 4 'a gap of 8.000 mm .* 1 slice(s) missing' missing
grep -q 'IM_0008.dcm and .*IM_0010.dcm' message || fail "the slices around the gap are not named"
cp -r good twice && cp good/IM_0007.dcm twice/copy.dcm
refused 4 'two images at one position' twice
grep -q 'IM_0007.dcm' message && grep -q 'copy.dcm' message || fail "the two images are not named"

if [ ! -d "$scans" ]; then echo "SKIPPED: no $scans; import was not tried on real scans"; exit 0; fi

# real series: the same value at the same place as dcm2niix (the mouse's slope gives 1.4e4 in float32: 2e-3)
for series in lower_torso_ct/series mouse_abdomen_mr/series abdomen_ct_j2k/series_j2k liver_ct_with_seg/ct-3slice \
  liver_ct_with_seg/23x38x3/image liver_ct_with_seg/24x38x3/multiframe codecs_and_malformed/slicer_CTHead64; do
  rm -rf nii && mkdir nii
  dcm2niix -p n -z n -f scan -o nii "$scans/$series" >/dev/null 2>&1
  "$bin/palpate-import" "$scans/$series" real.nii.gz --quiet --force
  "$bin/test-same-scan" real.nii.gz nii/scan.nii 2e-3
done

refused 4 'a gap of 6.999 mm' "$scans/head_ct_tilted/GE_tilt_uneven"
refused 4 'different size' "$scans/codecs_and_malformed/mixed_PT_secondary"
refused 2 'Image 23x38x3' "$scans/liver_ct_with_seg"

# the same image in every lossless codec: the same voxels. One file of the suite GDCM 3.0.21 cannot decode, and says so.
for image in CT1 CT2 MR1 MR2 MR3 MR4; do
  mkdir -p $image.REF && cp "$scans/codecs_and_malformed/WG04/REF/${image}_UNC" $image.REF
  "$bin/palpate-import" $image.REF $image.nii.gz --quiet
  for codec in J2KR JLSL JPLL RLE; do
    mkdir -p $image.$codec && cp "$scans/codecs_and_malformed/WG04/$codec/${image}_$codec" $image.$codec
    if [ $image.$codec = MR1.JLSL ]; then refused 3 'cannot be decoded' MR1.JLSL; continue; fi
    "$bin/palpate-import" $image.$codec $image.$codec.nii.gz --quiet
    "$bin/test-same-scan" $image.nii.gz $image.$codec.nii.gz 0 >/dev/null || fail "$image.$codec differs from its uncompressed twin"
  done
done

# everything else that is meant to hurt: an answer of its own, never a crash, nothing left behind
find "$scans/codecs_and_malformed/pydicom" "$scans/codecs_and_malformed/pydicom-data" "$scans/codecs_and_malformed/enhanced_mr" -name '*.dcm' |
  while read -r file; do
    rm -rf one one.nii.gz* && mkdir one && cp "$file" one
    got=0
    timeout 60 "$bin/palpate-import" one one.nii.gz --quiet 2>message || got=$?
    case $got in
      0) ls one.nii.gz one.nii.gz.card.json >/dev/null ;;
      3 | 4) if ls -d .*partial* one.nii.gz* 2>/dev/null; then fail "$file: left something behind"; fi ;;
      *) fail "$file: exit code $got" ;;
    esac
  done
rm -rf one one.nii.gz* && mkdir one && cp "$scans/codecs_and_malformed/pydicom/MR_truncated.dcm" one
refused 3 'truncated' one
# The codestream says unsigned where the header says signed: the header is right (first value −2000).
cp "$scans/codecs_and_malformed/pydicom/J2K_pixelrep_mismatch.dcm" one/ && rm one/MR_truncated.dcm
"$bin/palpate-import" one signed.nii.gz --quiet
grep -q '"min": -2000.0' signed.nii.gz.card.json || fail "the sign of the pixels is lost"
echo "import: good"
