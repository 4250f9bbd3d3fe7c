#!/usr/bin/env bash
# A set of a pressed organ whose curves the loop solves by itself: nothing hidden is nothing found, a rig that drifts is named; a second set of the same organ takes no further solve.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
here=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp data/studies/lamb_kidney/phantom.toml "$folder"
sed 's/^edge = 4.5/edge = 2.2/; s/^focus_edge = .*/focus_edge = 1.2/; s/^focus_radius = .*/focus_radius = 3.5/; s/^edge = 7.0/edge = 5.0/' data/studies/lamb_kidney/coarse.toml >"$folder/study.toml"
cd "$folder"
"$bin/palpate" run study.toml --quiet
mkdir organ && cp result/mesh.vtu organ/
"$bin/palpate-mesh" result/surface.vtp truth.vtu --edge 5.5 --focus 6.5,-12.1,0 --focus-edge 0.5 --focus-radius 2.7 --quiet
sed 's/^law = .*/law = "neo_hookean"/; /^b = /d; s/^schema.*/&\nmesh = "mesh.vtu"/' "$here/data/studies/lamb_kidney/fung_demiray.toml" >organ/case.toml
python3 "$here/bench/hidden/solved.py" "$bin" organ/case.toml truth.vtu solves sets --effects none,drift --seed 5
for name in none drift; do
  "$bin/palpate-loop" run "sets/${name}_0/set.toml" "$name" --solves kept --quiet --null-sets 200 >/dev/null
  find kept -name history.csv | wc -l >"$name.count"
done
cmp none.count drift.count || { echo "the second set was solved again" >&2; exit 1; }

# changes on a coarser mesh: the curve stays that of the case's mesh
"$bin/palpate-mesh" result/surface.vtp search.vtu --edge 6 --focus 6.5,-12.1,0 --focus-edge 1.8 --focus-radius 3 --quiet
sed 's#^case = .*#&\nsearch_mesh = "../../search.vtu"#' sets/none_0/set.toml >sets/none_0/searched.toml
"$bin/palpate-loop" run sets/none_0/searched.toml searched --solves kept --quiet --null-sets 200 >/dev/null
# a narrower organ in its place is refused, and says why
mkdir narrow
sed 's/^width_mm.*/width_mm = 20/' phantom.toml >narrow/phantom.toml
sed 's/^focus_edge = .*/focus_edge = 1.8/' study.toml >narrow/study.toml
"$bin/palpate" run narrow/study.toml --quiet
sed 's#^case = .*#&\nsearch_mesh = "../../narrow/result/mesh.vtu"#' sets/none_0/set.toml >sets/none_0/narrow.toml
code=0
"$bin/palpate-loop" run sets/none_0/narrow.toml refused --solves kept --quiet --null-sets 200 >/dev/null 2>refused.txt || code=$?
if [ $code != 6 ] || ! grep -q "on the search mesh the force is 0.3" refused.txt || ! grep -q "narrow/result/mesh.vtu" refused.txt || [ -e refused ]; then
  echo "another organ as a search mesh: code $code" >&2
  cat refused.txt >&2
  exit 1
fi

python3 - <<'P'
import json
none, drift, searched = (json.load(open(f"{name}/report.json")) for name in ("none", "drift", "searched"))
truth = [json.loads(line) for line in open("sets/answers.jsonl")][1]["knobs"]["drift"]
for report in (none, drift):
    print(report["verdict"]["kind"], report["verdict"]["effects"], [(c["tool"], c["solved_over_closed"], c["finer_mesh_shift"], c["nodes"]) for c in report["solved_curves"]])
assert none["verdict"]["kind"] == "nothing_supported", none["verdict"]
assert drift["verdict"]["effects"] == ["drift"], drift["verdict"]
value = next(p["value"] for p in drift["parameters"] if p["name"] == "drift.d")
assert abs(value / truth - 1) <= 0.1, (value, truth)
assert all(c["finer_mesh_shift"] < 0 for c in none["solved_curves"]), "a finer mesh is not softer"
assert searched["verdict"]["kind"] == "nothing_supported", searched["verdict"]
for own, coarse in zip(none["solved_curves"], searched["solved_curves"]):
    assert coarse["solved_over_closed"] == own["solved_over_closed"] and coarse["finer_mesh_shift"] == own["finer_mesh_shift"], "the curve hangs on the search mesh"
    far = [abs(a["deepest"] / b["deepest"] - 1) for x, y in zip(own["changes"], coarse["changes"]) for a, b in zip(x["solved"], y["solved"])]
    print("changes on the search mesh apart", max(far))
    assert 0 < max(far) < 0.06, far
P
