#!/usr/bin/env bash
# palpate-loop claims what replicates carry and no more: a hidden relaxation is named with its size; one run alone only ranks; a hum, which is in
# no catalogue, is left unexplained; what the set says it cannot show is not offered.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
make=$PWD/bench/hidden/make.py
cd "$folder"

# hidden <name> <protocol> <effect> <seed>
hidden() {
  python3 "$make" --protocol "$2" --effect "$3" --seed "$4" --answers answers.jsonl "$1"
  "$bin/palpate-loop" run "$1/set.toml" "$1/loop" --quiet --forward closed --null-sets 200 >/dev/null
}
hidden relaxes short prony 4
hidden alone ramp prony 5
hidden hums short hum 6
python3 - <<'P'
import json

def report(name):
    return json.load(open(f"{name}/loop/report.json"))

answers = {a["set"]: a["knobs"] for a in map(json.loads, open("answers.jsonl"))}
r = report("relaxes")
assert r["verdict"]["kind"] == "claimed" and r["verdict"]["effects"] == ["prony"], r["verdict"]
g = next(p for p in r["parameters"] if p["name"] == "prony.g")
assert abs(g["value"] / answers["relaxes"]["prony"] - 1) <= 0.1, g  # the design's 10 %
before, after = r["error"]["before"]["holdout"], r["error"]["after"]["holdout"]
assert after["times_noise_floor"] <= 1.2 and after["N"] < 0.5 * before["N"], (before, after)  # the design's 1.2
assert r["sealed_looks"] == 1
spots = {b["effect"]: b for b in r["blind_spots"]}
assert not spots["gain"]["visible"], spots["gain"]  # a factor on everything is the modulus

r = report("alone")
assert r["verdict"]["kind"] == "ranking_only" and r["verdict"]["effects"] == [], r["verdict"]
assert "replicate" in r["next_experiment"]["run"], r["next_experiment"]

r = report("hums")
assert r["verdict"]["kind"] == "unexplained" and r["verdict"]["effects"] == [], r["verdict"]
P

# A ramp without unloading cannot show what needs one.
awk -F, -v OFS=, 'NR==1 || $1<4' alone/r01.csv >cut.csv && mv cut.csv alone/r01.csv
"$bin/palpate-loop" blindspots alone/set.toml >spots.json
python3 - <<'P'
import json
spots = {b["effect"]: b for b in json.load(open("spots.json"))}
for name in ("friction", "mullins", "backlash", "permanent_set", "adhesion"):
    assert not spots[name]["visible"] and spots[name]["told"] == "no run unloads", spots[name]
assert spots["lag"]["told"] == spots["prony"]["told"] == "no hold, no unloading and one rate only", spots["lag"]
P
