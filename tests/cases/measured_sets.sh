#!/usr/bin/env bash
# What the loop says of measured data without replicates: it ranks and claims nothing; relaxation comes first for beef that is pressed and held, whose contact nobody
# knows, and explains it; what was fitted to one kind of test predicts the others better than before.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
data=${PALPATE_SHARED_DATA:-../shared/data}
if [ ! -d "$data/measured" ]; then echo "SKIPPED: no measured data at $data/measured"; exit 0; fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 data/studies/measured_sets/make.py "$data" "$folder/sets"
mkdir "$folder/out"
for set in "$folder"/sets/*/; do
  name=$(basename "$set")
  if [ "$name" != silicone ]; then  # replicates and closed forms of a thin slab: a study of its own
    "$bin/palpate-loop" run "$set/set.toml" "$folder/out/$name" --quiet --forward closed >/dev/null
  fi
done
python3 - "$folder/out" <<'P'
import json, pathlib, sys

pieces = 0
for path in sorted(pathlib.Path(sys.argv[1]).glob("*/report.json")):
    name, report = path.parent.name, json.loads(path.read_text())
    verdict, before, after = report["verdict"], report["error"]["before"], report["error"]["after"]
    assert verdict["kind"] == "ranking_only" and verdict["effects"] == [], (name, verdict)
    if name.startswith("beef"):
        pieces += 1
        assert verdict["alternatives"][0] == ["prony"], (name, verdict)
        assert before["fit"]["percent"] < 25 and after["fit"]["percent"] < 5, (name, before, after)
    if before["holdout"]:
        assert after["holdout"]["percent"] <= before["holdout"]["percent"], (name, before, after)
    print(name, [round(e[k]["percent"], 1) for k in ("fit", "holdout") if before[k] for e in (before, after)], *verdict["alternatives"][:1])
assert pieces == 26, pieces
P
