# palpate-surface: labels and brought surfaces become surfaces that pass every check, bad ones are refused with a place; same bytes on a rerun.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$bin/test-surface-shapes" .

# refused CODE WORDS ARGUMENTS...: the exit code, words of the message, and nothing left behind
refused() {
  local code=$1 words=$2 got=0
  shift 2
  "$bin/palpate-surface" "$@" --quiet 2>message || got=$?
  if [ "$got" != "$code" ] || ! grep -q -- "$words" message; then
    echo "expected exit code $code and \"$words\", got $got and:"; cat message; exit 1
  fi
  if ls .partial-* bad.vtp bad.vtp.card.json 2>/dev/null; then echo "left something behind"; exit 1; fi
}
card_says() { grep -q -- "$2" "$1.vtp.card.json" || { echo "$1: the card does not say $2"; cat "$1.vtp.card.json"; exit 1; }; }

for shape in ball mirrored ring two cut; do
  "$bin/palpate-surface" $shape.nii.gz $shape.vtp --quiet
  if grep -q '"pass": false' $shape.vtp.card.json; then echo "$shape: a check failed"; exit 1; fi
done
card_says ring '"genus": 1'
card_says two '"value": 2.0'
card_says cut 'the organ is cut there'
card_says two "\"2\": \"label_2\""

for brought in globe.vtp globe.stl small_hole.vtp; do
  "$bin/palpate-surface" $brought mended.vtp --quiet --force
  if grep -q '"pass": false' mended.vtp.card.json; then echo "$brought: a check failed"; exit 1; fi
done
card_says mended '"holes_closed": \['
card_says mended 'hole closed: 80 edges'
card_says mended "\"3\": \"globe\""

for threads in 1 2; do
  "$bin/palpate-surface" two.nii.gz again.vtp --quiet --force --threads $threads
  cmp two.vtp again.vtp
done
"$bin/palpate-surface" two.nii.gz one.vtp --quiet --labels 2
card_says one '"value": 1.0'

refused 4 "the labels are empty" empty.nii.gz bad.vtp
refused 3 "not whole numbers" nan.nii bad.vtp
refused 2 "present are: 1, 2" two.nii.gz bad.vtp --labels 7
refused 2 "not a label" two.nii.gz bad.vtp --labels kidney
refused 3 "no such file" missing.nii.gz bad.vtp
refused 4 "genus" ring.nii.gz bad.vtp --max-genus 0
refused 4 "components" ball.nii.gz bad.vtp --pieces 2
refused 4 "a hole that cannot be closed.*mm across" large_hole.vtp bad.vtp
refused 4 "hole around (.*) mm" large_hole.vtp bad.vtp
refused 4 "crosses itself" crossing.vtp bad.vtp
echo nonsense >nonsense.stl
refused 3 "not a readable surface" nonsense.stl bad.vtp
