#!/usr/bin/env bash
# palpate-report on a made-up study: same bytes again, bad input named, nothing left behind, and the page as a browser sees it.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "report.sh: $1" >&2; exit 1; }

report() { "$bin/palpate-report" --quiet "$@"; }

# expect CODE TEXT COMMAND...: the command ends with CODE, its message has TEXT, and no page or temporary file is left.
expect() {
  local code=$1 text=$2 got=0
  shift 2
  "$@" >"$work/out" 2>&1 || got=$?
  [ "$got" = "$code" ] || fail "exit code $got, not $code, of: $* : $(cat "$work/out")"
  grep -qF -- "$text" "$work/out" || fail "no \"$text\" in the message of $*: $(cat "$work/out")"
  [ -z "$(find "$work" -name '.partial-*' -o -name 'bad.html*')" ] || fail "something was left behind by $*"
}

"$bin/test-make-study" "$work/study"
cd "$work"

# --- same bytes: on a rerun, for another thread count, with a strange DISPLAY; current when nothing changed ----------------
report study study/report.html
cp study/report.html first.html
[ "$(report --skip-current --force study study/report.html)" = current ] || fail "an unchanged study is not current"
DISPLAY=:4711 report --threads 1 --force study study/report.html
cmp first.html study/report.html || fail "other bytes with one thread"
env -u DISPLAY "$bin/palpate-report" --quiet --threads 2 --force study study/report.html
cmp first.html study/report.html || fail "other bytes with two threads"

# --- what is missing is left out, what changed is read again --------------------------------------------------------------
cp -r study short && rm -r short/solve short/report.html*
report short short/report.html
grep -q 'smallest dihedral angle is 12.5°' short/report.html || fail "a study that ends at the mesh does not say so"
if grep -q 'id="force"' short/report.html; then fail "forces without a solve"; fi
cp -r study changed && sed -i 's/^2,4,/2,4.5,/' changed/solve/neo_hookean/history.csv
[ "$(report --skip-current --force changed changed/report.html)" != current ] || fail "a changed history is taken for current"
grep -q '4 to 4.5 mm' changed/report.html || fail "the changed depth is not in the page"
if grep -q 'id="plot-motion"' changed/report.html; then fail "forces over time though every tool goes deeper at each step"; fi
cp -r study held && sed -i 's/^2,4,/2,3.8,/' held/solve/neo_hookean/history.csv
report --force held held/report.html
grep -q 'id="plot-motion"' held/report.html || fail "no forces over time though a tool is lifted"

# --- bad input ---------------------------------------------------------------------------------------------------------------
bad() { rm -rf bad && cp -r study bad; }
mkdir empty && echo hello >empty/notes.txt
expect 3 'nothing to show' report empty bad.html
expect 3 'no such folder' report nowhere bad.html
bad && sed -i 's/^0.5,1,/0.5,nan,/' bad/solve/fung_demiray/history.csv
expect 3 'history.csv, line 7' report bad bad.html
bad && sed -i 's/^0.5,1,/0.5,/' bad/solve/fung_demiray/history.csv
expect 3 'history.csv, line 7' report bad bad.html
bad && sed -i 's/F\[N\]/G[N]/' bad/solve/fung_demiray/history.csv
expect 3 'no values of F[N]' report bad bad.html
bad && : >bad/solve/fung_demiray/history.csv
expect 3 'history.csv' report bad bad.html
bad && head -c 300 bad/mesh.vtu.card.json >cut && cp cut bad/mesh.vtu.card.json
expect 3 'mesh.vtu.card.json' report bad bad.html
bad && sed -i 's/"bin_deg": 10/"bin_deg": "ten"/' bad/mesh.vtu.card.json
expect 3 'mesh.vtu.card.json' report bad bad.html
bad && sed -i 's/"pass": true/"pass": "yes"/' bad/mesh.vtu.card.json
expect 3 'mesh.vtu.card.json' report bad bad.html
bad && echo '[1, 2]' >bad/study.json
expect 3 'study.json' report bad bad.html
bad && echo '{"title": "x", "stages": [{"output": "mesh.vtu"}]}' >bad/study.json
expect 3 'study.json' report bad bad.html
bad && sed -i 's/"first_contact_mm": \[/"first_contact_mm": ["here", /' bad/solve/neo_hookean/summary.json
expect 3 'summary.json' report bad bad.html
for file in mesh.vtu surface.vtp labels.sheet.png solve/neo_hookean/frames/frame_0001.vtu solve/neo_hookean/frames.pvd; do
  bad && head -c $(($(stat -c %s "bad/$file") * 6 / 10)) "bad/$file" >cut && cp cut "bad/$file"
  expect 3 "$file" report bad bad.html
done
bad && rm bad/solve/neo_hookean/frames/frame_0001.vtu
expect 3 'frame_0001.vtu' report bad bad.html
bad && cp bad/mesh.vtu bad/solve/neo_hookean/frames/frame_0001.vtu
expect 3 'the field displacement is missing' report bad bad.html
expect 3 'apt install xvfb' env -u DISPLAY PATH=/nowhere "$bin/palpate-report" --quiet study bad.html

# --- kill -9: the X server goes too; the next run tidies up ----------------------------------------------------
rm -f study/report.html*
"$bin/palpate-report" --quiet study study/report.html 2>"$work/killed" &
victim=$!
server=""
for _ in $(seq 400); do
  server=$(grep -lsE "^PPid:[[:space:]]*$victim\$" /proc/[0-9]*/status | grep -oE '[0-9]+' | head -1) || true
  [ -z "$server" ] || break
  sleep 0.01
done
kill -9 "$victim" || fail "the report was done before it could be killed"
wait "$victim" 2>/dev/null || true  # the shell says "Killed": that is meant
[ -n "$server" ] || fail "no X server was seen"
runs() { grep -qsE '^State:[[:space:]]*[^Z]' "/proc/$1/status"; }  # a zombie that nobody waits for does not run
for _ in $(seq 200); do runs "$server" || break; sleep 0.05; done
if runs "$server"; then fail "the X server outlives a killed report"; fi
[ ! -e study/report.html ] || fail "a killed report left a page"
report study study/report.html
cmp first.html study/report.html || fail "other bytes after kill -9"
[ -z "$(find study -name '.partial-*')" ] || fail "a killed report's temporary file is still there"

# --- offline: no address is fetched --------------------------------------------------------------------------------------------
if grep -oE '(src|href)="[^"#d][^"]{0,40}|url\([^)]{0,40}|@import' study/report.html; then fail "the page refers to something outside"; fi

# --- as a browser sees it --------------------------------------------------------------------------------------------------------
if ! command -v chromium >/dev/null; then
  echo "report.sh: SKIPPED: no chromium, so nobody looked at the page (scripts/install-deps --tests)" >&2
  exit 0
fi

# look PAGE: leaves what the page found of itself in self_check, and the console's messages in console.
look() {
  local profile
  profile=$(mktemp -d -p "$work")
  timeout 120 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir="$profile" \
    --enable-logging=stderr --virtual-time-budget=10000 --dump-dom "file://$PWD/$1" >dom 2>log || fail "chromium failed on $1: $(tail -3 log)"
  console=$(grep -a ':CONSOLE' log || true)
  self_check=$(grep -ao 'data-self-check="[^"]*"' dom | sed 's/&quot;/"/g' || true)
}

look study/report.html
[ -z "$console" ] || fail "the console says: $console"
grep -qF '"pictures":12,"pictures_drawn":12,"plots":2,"plots_drawn":2,"errors":[],"well":true' <<<"$self_check" || fail "the page finds: $self_check"

# The same look must notice a page that is broken.
look_notices() {  # PAGE WHAT TEXT...: each TEXT is in what was found
  look "$1"
  if cmp -s "$1" study/report.html; then fail "$2: the page was not changed"; fi
  if grep -qF '"well":true' <<<"$self_check"; then fail "not noticed: $2"; fi
  for text in "${@:3}"; do grep -qF -- "$text" <<<"$self_check$console" || fail "$2: no $text in: $self_check $console"; done
}
sed '0,/base64,iVBORw0KGgo/s//base64,AAAAAAAAAAA/' study/report.html >broken_picture.html
look_notices broken_picture.html "a broken picture" '"pictures_drawn":11'
sed 's/^  let charts = \[\];/  throw new Error("made to fail");/' study/report.html >throws.html
look_notices throws.html "a script that throws" 'made to fail' ':CONSOLE'
sed 's/"series":\[.*\]}</"series":[]}</' study/report.html >no_curve.html
look_notices no_curve.html "a plot without a curve" '"plots_drawn":1'
sed 's|<main>|<main><img alt="" src="http://127.0.0.1:9/x.png">|' study/report.html >outside.html
look_notices outside.html "a picture from outside" 'blocked: http://127.0.0.1:9' ':CONSOLE'
