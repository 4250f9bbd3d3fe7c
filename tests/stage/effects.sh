#!/usr/bin/env bash
# Every effect of the solver's catalogue in a case.toml: it runs, it counts, its amplitude has a derivative; misspelt keys are refused with the nearest.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() { echo "$1" >&2; exit 1; }

"$bin/test-block" mesh.vtu 7 3 0 3 20  # 40 × 40 × 20 mm, cells of about 7 mm
cat >plain.toml <<'CASE'
schema = "palpate-case/1"
[material]
law = "fung_demiray"
mu = 0.0067
b = 1.3
[base]
plane = { point_mm = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }
[tool]
kind = "ball"
radius_mm = 10.0
aim_mm = [1.0, 2.0, 20.0]
axis = [0.1, 0.0, -1.0]
path = [[0, 0], [1, 3.0], [2, 2.0]]
[steps]
count = 4
frames = 1
CASE
solve() { "$bin/palpate-solve" "$@" --quiet --force </dev/null; }
last_force() { tail -n 1 "$1/history.csv" | cut -d, -f6; }

solve plain.toml plain >plain.log
"$bin/palpate-solve" --catalogue >catalogue.json
python3 - <<'PY'
import json
effects = [e for e in json.load(open("catalogue.json")) if e["kind"] == "effect"]
sockets = {"stress": "", "start": "", "traction": "", "layer": "", "force": 'box = { min_mm = [-20.1, -20.1, -1.0], max_mm = [-19.9, 20.1, 21.0] }\n'}
seen = set()
for e in effects:
    socket = e["sentence"].rsplit("(", 1)[1].rstrip(")")
    seen.add(socket)
    text = f'[[effect]]\nname = "{e["name"]}"\n{sockets[socket]}'
    for p in e["parameters"]:
        text += f'{p["name"]} = {p["typical"]!r}\n'
    open(f'{e["name"]}.toml', "w").write(open("plain.toml").read() + text)
    open(f'{e["name"]}.wrong.toml', "w").write(open("plain.toml").read() + text.replace(f'\n{e["parameters"][0]["name"]} =', f'\n{e["parameters"][0]["name"]}x ='))
assert seen == set(sockets), seen
open("names", "w").write("".join(f'{e["name"]} {e["parameters"][0]["name"]}\n' for e in effects))
PY
while read -r name amplitude; do
  solve "$name.toml" "$name" --sensitivities "effect[0].$amplitude" >"$name.log" || fail "$name does not run: $(cat "$name.log")"
  awk -v a="$(last_force plain)" -v b="$(last_force "$name")" 'BEGIN { d = a - b; exit !((d > 0 ? d : -d) > 1e-4 * a) }' || fail "$name changes nothing"
  python3 - "$name" <<'PY'
import csv, json, math, sys
name = sys.argv[1]
rows = list(csv.reader(open(f"{name}/sensitivities.csv")))
values = [float(row[1]) for row in rows[1:]]
assert all(map(math.isfinite, values)) and any(values), values
assert json.load(open(f"{name}/summary.json"))["effects"][0]["name"] == name
PY
  code=0
  solve "$name.wrong.toml" wrong 2>wrong.log >/dev/null || code=$?
  [ "$code" = 2 ] || fail "$name: a misspelt $amplitude ends with $code"
  grep -q "$amplitude" wrong.log || fail "$name: the message does not name $amplitude: $(cat wrong.log)"
done <names

# A name that there is not, a socket's key where it does not belong, a place outside.
refused() {  # refused <what it must say> <effect's table>
  printf '%s\n[[effect]]\n%b\n' "$(cat plain.toml)" "$2" >refused.toml
  local code=0
  solve refused.toml wrong 2>wrong.log >/dev/null || code=$?
  [ "$code" = 2 ] || fail "'$2' ends with $code: $(cat wrong.log)"
  grep -q "$1" wrong.log || fail "'$2' is refused without saying '$1': $(cat wrong.log)"
}
refused capsule 'name = "capsul"\nE_h = 0.1'
refused tension 'name = "capsule"\nE_h = 0.1\ntensoin = 0.1'
refused 'plane, box, label' 'name = "support"\nstiffness = 0.1'
refused tool 'name = "prestress"\np_kPa = 1\ntool = 1'
refused region 'name = "capsule"\nE_h = 0.1\nregion = "block"'
refused tool 'name = "adhesion"\nwork = 0.1\nrange_mm = 1\ntool = 2'
refused 'changes nothing' 'name = "inclusion"\nexcess = 2\nx_mm = 90\ny_mm = 0\nz_mm = 0\nradius_mm = 3'
echo "effects: $(wc -l <names) run, count and are differentiated"
