#!/usr/bin/env bash
# palpate-report on a loop's folder: the verdict, every run's two plots, every candidate; damaged files named; drawn as a browser sees it.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "report_loop.sh: $1" >&2; exit 1; }

# Two tensile tests of a stiffening tissue, which a neo-Hookean law cannot follow; a third is sealed.
python3 - <<'P'
import math, random
random.seed(1)
text = 'schema = "palpate-set/1"\n[specimen]\nid = "<strip>"\nlaw = "neo_hookean"\n[rig]\ncompliance_mm_per_N = 0.0\n'
for run, role in (("a", "fit"), ("b", "fit"), ("c", "holdout")):
    with open(f"{run}.csv", "w") as out:
        out.write("t[s],stretch[1],P[MPa]\n")
        for i in range(60):
            s = 1 + i / 100
            i1 = s * s + 2 / s - 3
            out.write(f"{i / 10},{s},{0.02 * math.exp(0.8 * i1) * (s - s**-2) + random.gauss(0, 1e-5)}\n")
    text += f'[[run]]\nid = "{run}"\nfile = "{run}.csv"\ntest = "uniaxial"\nrole = "{role}"\nreplicate = "g"\n'
open("set.toml", "w").write(text)
P
"$bin/palpate-loop" run set.toml loop --quiet --null-sets 200 >/dev/null
"$bin/palpate-report" --quiet loop page.html
python3 - <<'P'
import html, json, re
r, page = json.load(open("loop/report.json")), open("page.html").read()
assert html.escape(r["verdict"]["sentence"], quote=False) in html.unescape(page).replace("<", "&lt;").replace(">", "&gt;") or r["verdict"]["sentence"] in html.unescape(page)
assert "&lt;strip&gt;" in page and "<strip>" not in page, "the specimen's name is not made safe"
for c in r["candidates"] + r["blind_spots"]:
    assert f'>{c["effect"]}</th>' in page, c
plots = {i: json.loads(t) for i, t in re.findall(r'<script type="application/json" id="([^"]+)">(.*?)</script>', page)}
rows = [line.split(",") for line in open("loop/curves.csv")][1:]
runs = sorted({row[0] for row in rows})
assert len(plots) == 2 * len(runs), plots.keys()
scales = [p["y_range"] for i, p in plots.items() if not i.endswith("rest")]
assert all(s == scales[0] for s in scales), "not one scale"
assert all(p["x"] == ("time (s)" if i.endswith("rest") else "stretch") for i, p in plots.items()), {p["x"] for p in plots.values()}
for k, run in enumerate(runs):
    curve, rest = plots[f"plot-run-{k}"], plots[f"plot-run-{k}-rest"]
    mine = [row for row in rows if row[0] == run]
    factor = 1e3 if "kPa" in curve["y"] else 1
    for row, m, a, left in zip(mine, curve["series"][0]["points"], curve["series"][2]["points"], rest["series"][2]["points"], strict=True):
        t, u, measured, after = float(row[3]), float(row[4]), float(row[5]), float(row[7])
        assert abs(m[0] - u) < 1e-12 and abs(m[1] - factor * measured) <= 1e-9 and abs(a[1] - factor * after) <= 1e-9
        assert abs(left[0] - t) < 1e-12 and abs(left[1] - factor * (measured - after)) <= 1e-9
P

# expect CODE TEXT: of the report on the damaged folder; nothing is left.
expect() {
  local got=0
  "$bin/palpate-report" --quiet bad bad.html 2>message || got=$?
  [ "$got" = "$1" ] && tr '\n' ' ' <message | grep -qE -- "$2" || fail "exit code $got, not $1 with \"$2\": $(cat message)"
  [ ! -e bad.html ] || fail "a page was left of a damaged folder"
}
bad() { rm -rf bad && cp -r loop bad; }
bad && sed -i '5s/[^,]*$/x/' bad/curves.csv && expect 3 'curves.csv:5'
bad && sed -i '7s/,[^,]*$//' bad/curves.csv && expect 3 '8 cells instead of 9.*curves.csv:7'
bad && sed -i '2,$d' bad/curves.csv && expect 3 'no run'
bad && head -c 400 loop/report.json >bad/report.json && expect 3 'report.json'
bad && python3 -c 'import json; r = json.load(open("bad/report.json")); del r["verdict"]; json.dump(r, open("bad/report.json", "w"))' && expect 3 'lacks something.*verdict'

if ! command -v chromium >/dev/null; then
  echo "report_loop.sh: SKIPPED: no chromium, so nobody looked at the page (scripts/install-deps --tests)" >&2
  exit 0
fi
timeout 120 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking --disable-component-update \
  --disable-sync --host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir="$work/profile" --virtual-time-budget=10000 --dump-dom "file://$PWD/page.html" >dom 2>log ||
  fail "chromium failed: $(tail -3 log)"
grep -ao 'data-self-check="[^"]*"' dom | sed 's/&quot;/"/g' | grep -qF '"plots":6,"plots_drawn":6,"errors":[],"well":true' || fail "the page finds: $(grep -ao 'data-self-check="[^"]*"' dom)"
