# palpate run: order, skipping, failure, misuse, interruption, on stand-in stages; then on palpate-mesh itself. palpate list, palpate <stage>.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
real=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir bin
cp "$real/palpate" bin/

# A stand-in stage: its output's bytes follow from its inputs' bytes and its options; "fail" and "slow" are options.
cat >stage <<'STAGE'
#!/bin/bash
set -euo pipefail
name=${0##*/palpate-}
case "${1-}" in
  --describe)
    side=''
    [ "$name" = segment ] && side=', {"name": "sheet", "suffix": ".sheet.png", "beside": "labels"}'
    echo '{"name": "palpate-'$name'", "outputs": [{"name": "main"}'"$side"'], "common_options": [{"name": "seed", "kind": "integer"}], "options": [
      {"name": "smoothing-mm", "kind": "real"}, {"name": "seeds", "kind": "points"}, {"name": "deep", "kind": "flag"},
      {"name": "truth", "kind": "file"}, {"name": "fail", "kind": "flag"}, {"name": "slow", "kind": "flag"}, {"name": "mesh", "kind": "file"}]}'
    exit ;;
  --catalogue) echo '[{"kind": "method", "name": "'$name'_way", "sentence": "How.", "reference": "", "parameters": []}]'; exit ;;
esac
echo "$name $*" >>"$CALLS"
files=() options=() skip=0
for word; do
  case $word in
    --force|--threads=*|--quiet) ;;
    --skip-current) skip=1 ;;
    --fail) echo "palpate-$name: asked to fail" >&2; exit 4 ;;
    --slow) echo $$ >"$CALLS.pid"; exec sleep 60 ;;
    --*) options+=("${word##*/}") ;;
    *) files+=("$word") ;;
  esac
done
[ "$name" = report ] && input=$(cat "${files[0]}/study.json" "${files[0]}"/solve/* 2>/dev/null | sha256sum) || input=$(find "${files[0]}" -type f -exec cat {} + | sha256sum)
mesh=$(printf '%s\n' "$@" | sed -n 's/^--mesh=//p')
[ -z "$mesh" ] || input+=$(sha256sum <"$mesh")
content="$name $input ${options[*]-}"
out=${files[1]}
if [ $skip = 1 ] && [ -f "$out.card.json" ] && [ "$(cat "$out.card.json")" = "$content" ]; then echo current; exit; fi
for file in "${files[@]:1}"; do
  if [ "$name" = phantom ]; then rm -rf "$file"; mkdir "$file"; echo "$content" >"$file/1"; else echo "$content" >"$file"; fi
done
echo "$content" >"$out.card.json"
STAGE
chmod +x stage
for name in phantom import segment surface mesh solve report; do cp stage bin/palpate-$name; done
export CALLS=$folder/calls

mkdir study
echo spec >study/phantom.toml; echo law >study/soft.toml; echo law >study/hard.toml
cat >study/study.toml <<'TOML'
schema = "palpate-study/1"
title = "A study"
[report]
[mesh]
smoothing_mm = 0.5
[segment]
seeds = [[-1.0, 2, 3.25], [4, 5, 6]]
deep = true
[phantom]
input = "phantom.toml"
[import]
[surface]
smoothing_mm = 1
[[solve]]
name = "soft"
input = "soft.toml"
[[solve]]
input = "hard.toml"
TOML

die() { echo "$1"; [ -f said ] && cat said; exit 1; }
# expect CODE WORD ARGUMENTS...: palpate's exit code, and a word of what it says
expect() {
  local code=$1 word=$2 got=0
  shift 2
  : >calls
  bin/palpate "$@" >out 2>said || got=$?
  [ "$got" = "$code" ] || die "expected exit code $code, got $got: palpate $*"
  [ -z "$word" ] || grep -q -- "$word" said || die "expected \"$word\": palpate $*"
}
stages_run() { cut -d' ' -f1 calls | tr '\n' ' '; }
outcomes() { sed -n 's/.*\] \([a-z_]*\).* \(current\|done\) .*/\1=\2/p' said | tr '\n' ' '; }
all="phantom import segment surface mesh solve solve report"

# The order is the chain's; the last line is the page; options, points and flags arrive.
expect 0 "" run study/study.toml
[ "$(stages_run)" = "$all " ] || die "wrong order: $(stages_run)"
[ "$(tail -n1 out)" = study/result/report.html ] || die "the page is not on stdout"
grep -q -- "^segment study/result/scan.nii.gz study/result/labels.nii.gz --deep --seeds=-1.0,2,3.25 --seeds=4,5,6 --force --skip-current$" calls || die "segment's options: $(grep ^segment calls)"
grep -q -- "^solve study/soft.toml study/result/solve/soft --mesh=study/result/mesh.vtu" calls || die "solve's line: $(grep ^solve calls)"
[ "$(outcomes | grep -o done | wc -l)" = 8 ] || die "eight stages should have been done: $(outcomes)"
cat >wanted <<'TEXT'
A study
phantom dicom,truth
import scan.nii.gz
segment labels.nii.gz,labels.sheet.png
surface surface.vtp
mesh mesh.vtu
solve soft solve/soft
solve hard solve/hard
report report.html
TEXT
python3 -c 'import json; r = json.load(open("study/result/study.json")); print(r["title"]); [print(s["name"], ",".join(s["outputs"])) for s in r["stages"]]' >got
cmp got wanted

# Again: all current, study.json untouched. One option changed: only what follows runs.
cp -p study/result/study.json before; stat -c %Y.%i study/result/study.json >stamp
expect 0 "" run study/study.toml
[ "$(outcomes | grep -o current | wc -l)" = 8 ] || die "all should be current: $(outcomes)"
[ "$(stat -c %Y.%i study/result/study.json)" = "$(cat stamp)" ] || die "study.json was written again"
sed -i 's/smoothing_mm = 1$/smoothing_mm = 2/' study/study.toml
expect 0 "" run study/study.toml
[ "$(outcomes)" = "phantom=current import=current segment=current surface=done mesh=done solve=done solve=done report=done " ] || die "after a change: $(outcomes)"
expect 0 "" run study/study.toml --force --quiet
[ ! -s said ] || die "--quiet should be quiet"
if grep -q skip-current calls; then die "--force should run every stage"; fi

# --out, --dicom (drops the phantom), and the words for all stages
mkdir series; echo slice >series/1
expect 0 "" run study/study.toml --out elsewhere --dicom series --threads 2 --seed 7
[ "$(stages_run)" = "import segment surface mesh solve solve report " ] || die "--dicom: $(stages_run)"
grep -q "^import series elsewhere/scan.nii.gz .*--threads=2 --seed=7$" calls || die "import's line: $(grep ^import calls)"

# change EDIT: a copy of the study with a sed script applied
change() { sed "$1" study/study.toml >study/bad.toml; }
change 's/^deep = true/fail = true/'
expect 4 "asked to fail" run study/bad.toml --out bad
grep -q "bad.toml:6" said || die "the section's line is missing"
[ "$(stages_run)" = "phantom import segment " ] || die "a failure should end the run: $(stages_run)"
change 's/^\[segment\]/[segmet]/';      expect 2 "did you mean segment" run study/bad.toml; grep -q "bad.toml:6" said || die "no line"
change 's/^deep/dep/';                  expect 2 "did you mean deep" run study/bad.toml;  grep -q "bad.toml:8" said || die "no line"
change 's/^deep = true/deep = 1/';      expect 2 "wrong kind of value" run study/bad.toml
change 's/^seeds.*/seeds = [[1, 2]]/';  expect 2 "wrong kind of value" run study/bad.toml
change 's/^input = "hard/name = "soft"\ninput = "hard/'; expect 2 "two solves are named" run study/bad.toml
change 's/^input = "hard/input = "lost/'; expect 3 "no such file" run study/bad.toml
change '/^\[segment\]/,/^deep/d';       expect 2 "there is no \[segment\] before it" run study/bad.toml
change 's/^schema.*/schema = "x"/';     expect 2 "palpate-study/1" run study/bad.toml
change 's/^name = "soft"/name = "a\/b"/'; expect 2 "not a name" run study/bad.toml
change 's/^title/title title/';         expect 3 "TOML" run study/bad.toml
expect 2 "did you mean --dicom" run study/study.toml --dicm series
expect 3 "no such file" run lost.toml
expect 2 "did you mean run" runs study/study.toml
expect 2 "missing: a command"
[ "$(stages_run)" = "" ] || die "misuse should start nothing"

# Killed, it takes its stage along.
for signal in TERM KILL; do
  change 's/^deep = true/slow = true/'
  rm -f calls.pid
  bin/palpate run study/bad.toml --out slow --quiet 2>/dev/null & run=$!
  for _ in $(seq 100); do [ -s calls.pid ] && break; sleep 0.05; done
  kill -$signal $run
  wait $run 2>/dev/null || true
  for _ in $(seq 100); do kill -0 "$(cat calls.pid)" 2>/dev/null || break; sleep 0.05; done
  if kill -0 "$(cat calls.pid)" 2>/dev/null; then die "the stage outlived palpate run (SIG$signal)"; fi
done
# A stage that is killed is a failure with a message.
bin/palpate run study/bad.toml --out slow >out 2>said & run=$!
rm -f calls.pid
for _ in $(seq 100); do [ -s calls.pid ] && break; sleep 0.05; done
kill -KILL "$(cat calls.pid)"
got=0; wait $run || got=$?
[ "$got" = 1 ] && grep -q "ended by a signal" said || die "a killed stage: exit code $got"

# list and the short way to a stage
[ "$(bin/palpate list --json | python3 -c 'import json, sys; print(len(json.load(sys.stdin)))')" = 7 ] || die "list --json"
bin/palpate list | grep -q "solve_way: How." || die "list"
: >calls
bin/palpate mesh study/soft.toml short.vtu --deep
[ "$(cat calls)" = "mesh study/soft.toml short.vtu --deep" ] || die "palpate mesh: $(cat calls)"
for question in --help --version --describe --xml --catalogue; do
  bin/palpate $question >/dev/null && bin/palpate run $question >/dev/null && bin/palpate list $question >/dev/null || die "$question"
done

# With the real palpate-mesh
mkdir mesh; "$real/test-shapes" mesh
cat >mesh/study.toml <<'TOML'
schema = "palpate-study/1"
title = "A mesh alone"
[mesh]
input = "ball.vtp"
min_dihedral = 7.5
TOML
"$real/palpate" run mesh/study.toml 2>said >out; [ "$(outcomes)" = "mesh=done " ] || die "real mesh"
"$real/palpate" run mesh/study.toml 2>said >out; [ "$(outcomes)" = "mesh=current " ] || die "real mesh again"
[ ! -s out ] || die "there is no page to print"
sed -i 's/min_dihedral = 7.5/min_dihedral = 75/' mesh/study.toml
code=0; "$real/palpate" run mesh/study.toml 2>said >out || code=$?
[ $code = 2 ] && grep -q "out of range: 75" said && grep -q "study.toml:3" said || die "a stage's misuse passes through"
