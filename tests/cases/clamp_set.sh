#!/usr/bin/env bash
# A set of a clamp by the whole solver: a short thick tube closed in its middle (bench/hidden/clamp.py), nothing hidden; what palpate-loop says of it, and of a run that stops elsewhere.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1 here=$(realpath "$(dirname "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 "$here/../../bench/hidden/clamp.py" "$bin" truth sets --coarse --seed 11 --effects none
"$bin/palpate-loop" run sets/set01/set.toml first --solves kept --threads 2 --quiet >/dev/null
"$bin/palpate-loop" run sets/set01/set.toml again --solves kept --threads 1 --quiet >/dev/null
python3 - <<'PY'
import json, pathlib
first, again = (json.load(open(f"{s}/report.json")) for s in ("first", "again"))
if not (first["verdict"]["kind"] == "nothing_supported" and again["verdict"] == first["verdict"]):
    raise SystemExit(f"nothing is hidden: {first['verdict']}, {again['verdict']}")
kept = [p.stat().st_mtime for p in pathlib.Path("kept").glob("*/asked.toml")]
if not (len(kept) == 15 and max(kept) < pathlib.Path("first/report.json").stat().st_mtime):  # three meshes, two with coarser folds, there friction and angle twice, three slices twice: the other half is their image
    raise SystemExit(f"{len(kept)} closings, or some again")
if first["solves"] != 15 or again["solves"] != 15: raise SystemExit(f"15 closings, not {first['solves']} and {again['solves']}")
if first["motion"] != "closure (mm)": raise SystemExit(f"jaws move by {first['motion']}")
sealed = first["error"]["before"]["holdout"]["percent"]
if not sealed <= 2: raise SystemExit(f"the run that stops elsewhere is foretold to {sealed} % of its largest force")
PY
echo "clamp: nothing found where nothing is, a stop elsewhere foretold"
