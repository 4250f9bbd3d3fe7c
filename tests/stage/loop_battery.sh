#!/usr/bin/env bash
# palpate-loop with a whole battery: an effect that two runs of a small ball tell stands beside a larger one; an inclusion under one site, pressed once, is
# seen; what permanent set leaves behind presses on no tool above it.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
make=$PWD/bench/hidden/make.py
cd "$folder"

# named <effects> <seed>
named() {
  python3 "$make" --protocol battery --effect "$1" --seed "$2" --answers answers.jsonl "$1"
  "$bin/palpate-loop" run "$1/set.toml" "$1/loop" --quiet --forward closed --null-sets 200 >/dev/null
  python3 - "$1" <<'P'
import json, sys
verdict = json.load(open(f"{sys.argv[1]}/loop/report.json"))["verdict"]
assert verdict["kind"] == "claimed" and sorted(verdict["effects"]) == sorted(sys.argv[1].split("+")), verdict
P
}
named thickness+friction 41414009
named inclusion 41414002
named permanent_set 41414001
