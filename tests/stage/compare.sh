# palpate-compare: two clamped tubes and a copy of one side by side; numbers by other ways, series, another source's growths, the page, bad input.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1 here=$(realpath "$(dirname "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

source "$here/clamp_case.bash"
mkdir -p study/solve
for wall in 1 1.5; do
  clamp_case "$wall" "$bin" "$wall"
  "$bin/palpate-solve" $wall.toml study/solve/tube-$wall --mesh $wall.vtu --quiet >/dev/null
done
cp -r study/solve/tube-1 copy
cat > paper.toml <<'TOML'
schema = "palpate-beside/1"
source = "a paper & its table"
[[growth]]
series = "tube"
quantity = "peak force"
from = 1
to = 1.5
percent = 80
TOML
"$bin/palpate-compare" study copy study/compare --over thickness --beside paper.toml --quiet >/dev/null
"$bin/palpate-compare" study copy again --over thickness --beside paper.toml --quiet >/dev/null
for file in compare.json compare.csv curves.csv; do cmp study/compare/$file again/$file; done
python3 - <<'PY'
import csv, json, math
d = json.load(open("study/compare/compare.json"))
assert d["results"] == ["tube-1", "tube-1.5", "copy"], d["results"]
rows = {r["quantity"]: r for r in d["rows"]}

def near(quantity, column, wanted, part, unit):
    got = rows[quantity]["values"][column]
    if not (abs(got - wanted) <= part * abs(wanted) and rows[quantity]["unit"] == unit):
        raise SystemExit(f"{quantity} of {d['results'][column]}: {got} {rows[quantity]['unit']}, not {wanted} {unit}")

for column, wall in enumerate((1, 1.5)):  # the mid-surface is the tube itself: 25 mm; a polygon of 2 mm to 3.6 mm chords
    near("thickness", column, wall, 1e-12, "mm")
    near("area", column, math.pi * 25 * 60, 0.01, "mm²")
    near("wall's volume", column, math.pi * 25 * 60 * wall, 0.01, "mm³")
    near("enclosed volume", column, math.pi * 12.5**2 * 60, 0.02, "mm³")
    near("mean diameter", column, 25, 0.01, "mm")
    near("least diameter", column, 25, 0.02, "mm")
    history = list(csv.DictReader(open(f"study/solve/tube-{wall}/history.csv")))
    force, depth = ([float(r[k]) for r in history] for k in ("F[N]", "depth[mm]"))
    near("peak force", column, max(force), 1e-12, "N")
    near("last force", column, force[-1], 1e-12, "N")
    near("work of the force", column, sum(b * (v - u) for b, u, v in zip(force[1:], depth, depth[1:])), 1e-9, "mJ")
    summary = json.load(open(f"study/solve/tube-{wall}/summary.json"))
    near("largest von Mises stress", column, summary["max_von_mises_MPa"], 1e-6, "MPa")  # the solver's own count, from its state
    near("99.5 % von Mises stress", column, summary["von_mises_995_MPa"], 1e-6, "MPa")
    near("largest strain", column, summary["max_strain"], 1e-6, "1")
    card = json.load(open(f"{wall}.vtu.card.json"))["notes"]["quality"]
    near("longest edge", column, card["worst"]["longest_edge_mm"], 1e-9, "mm")
    near("largest skew", column, card["worst"]["skew_deg"], 1e-9, "°")
    assert d["curves"][column]["force_N"] == force
for r in d["rows"]:
    assert r["values"][2] == r["values"][0], f"the copy differs in {r['quantity']}"
    a, b = r["values"][:2]
    if a and b is not None and not abs(r["change_percent"][1] - 100 * (b / a - 1)) <= 1e-9 * max(1, abs(100 * b / a)):
        raise SystemExit(f"change of {r['quantity']}: {r['change_percent'][1]}")
peak = rows["peak force"]["values"]
(growth,) = d["beside"]["growths"]
assert growth["theirs_percent"] == 80 and abs(growth["ours_percent"] - 100 * (peak[1] / peak[0] - 1)) < 1e-9, growth
assert [(s["name"], s["at"]) for s in d["over"]["series"]] == [("copy", [1]), ("tube", [1, 1.5])], d["over"]
table = list(csv.reader(open("study/compare/compare.csv")))
assert table[0] == ["group", "quantity", "unit"] + d["results"] and len(table) == 1 + len(d["rows"])
for line, r in zip(table[1:], d["rows"]):
    assert line[:3] == [r["group"], r["quantity"], r["unit"]]
    assert all((v is None and cell == "") or abs(float(cell) - v) <= 1e-11 * abs(v) for cell, v in zip(line[3:], r["values"])), line
assert sum(1 for _ in open("study/compare/curves.csv")) == 1 + sum(len(c["t_s"]) for c in d["curves"])
PY

"$bin/palpate-report" study page.html --quiet >/dev/null
python3 - <<'PY'
import base64, html, json, re
page, d = open("page.html").read(), json.load(open("study/compare/compare.json"))
plots = {i: json.loads(t) for i, t in re.findall(r'<script type="application/json" id="([^"]+)">(.*?)</script>', page)}
curves = plots["plot-compare-force"]["series"]
assert [c["name"] for c in curves] == d["results"] and [p[1] for p in curves[1]["points"]] == d["curves"][1]["force_N"]
force = next(p for i, p in plots.items() if i.startswith("plot-over") and p["y"] == "force (N)")
row = next(r for r in d["rows"] if r["quantity"] == "peak force")["values"]
assert next(s for s in force["series"] if s["name"] == "tube, peak force")["points"] == [[1, row[0]], [1.5, row[1]]], force
assert "a paper &amp; its table" in page, "the source is not made safe"
pictures = re.findall(r'alt="Organ pressed with ([^"]*)" src="data:image/png;base64,([^"]*)"', page)
assert len(pictures) == 6, "three pictures of each wall"
assert all(len(base64.b64decode(data)) > 5000 for _, data in pictures), "an empty picture"
PY
sed 's/"values"/"valves"/' -i again/compare.json && rm -r study/compare && mv again study/compare
if "$bin/palpate-report" study damaged.html --quiet 2>message || ! grep -q "not a comparison" message; then echo "a damaged comparison is not told:"; cat message; exit 1; fi

# refused CODE WORD ARGUMENTS...: refused with that code and word, and nothing is left
refused() {
  local code=$1 word=$2 got=0
  shift 2
  "$bin/palpate-compare" "$@" bad --quiet 2>message >/dev/null || got=$?
  if [ $got != "$code" ] || ! grep -q -- "$word" message || [ -e bad ]; then echo "expected $code and \"$word\" of $*, got $got and:"; cat message; exit 1; fi
}
refused 2 "did you mean thickness" copy --over thicknes
refused 2 "given twice" study study/solve/tube-1
refused 3 "neither a result" .
refused 2 "none is given" copy --beside paper.toml
refused 2 "no results of the series tube" copy --over thickness --beside paper.toml
sed 's/^to = 1.5/to = 2/' paper.toml > far.toml
refused 2 "has peak force at 2" study --over thickness --beside far.toml
sed 's/^percent/per_cent/' paper.toml > misspelt.toml
refused 2 "percent" study --over thickness --beside misspelt.toml
head -c 2000 copy/frames/frame_0000.vtu > cut.vtu && mv cut.vtu copy/frames/frame_0000.vtu
refused 3 "frame_0000.vtu" copy
rm -r copy/frames*
refused 3 "no frames" copy
echo "side by side, counted twice, bad input told"
