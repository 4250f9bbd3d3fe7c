# palpate-idealize and thin walls of palpate-mesh: the paper's cylinder, found again by the fit, cut and meshed within the paper's limits.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

"$bin/palpate-idealize" cylinder.vtp --quiet
"$bin/palpate-idealize" fitted.vtp --like cylinder.vtp --quiet
"$bin/palpate-idealize" tube.vtp --like cylinder.vtp --shape tube --quiet
shell="--kind shell --thickness 1.4 --offset -0.7 --focus 0,0,50 --focus-radius 15 --quiet"
"$bin/palpate-mesh" cylinder.vtp wall.vtu $shell
"$bin/palpate-mesh" cylinder.vtp again.vtu $shell --threads 2
cmp wall.vtu again.vtu
taskset -c "$(taskset -cp $$ | sed 's/.*: //; s/[-,].*//')" "$bin/palpate-idealize" one.vtp --quiet  # "all cores" are those that this process may use
grep -q '"threads": 1,' one.vtp.card.json || { echo "threads for cores that are not ours"; exit 1; }
"$bin/palpate-mesh" cylinder.vtp piece.vtu $shell --cut-from 20 --cut-to 80
python3 - <<'PY'
import json, math
card = lambda name: json.load(open(name + ".card.json"))["notes"]
fit, apart = card("fitted.vtp")["cylinder"], card("fitted.vtp")["difference"]
area = {name: card(name)["quality"]["area_mm2"] for name in ("wall.vtu", "piece.vtu")}
pi_d = math.pi * (25 - 1.4)
for name, value, wanted, tolerance in [  # mm: chords of 1 mm on a circle of 12.5 mm lie up to 0.01 mm inside
    ("diameter", fit["diameter_mm"], 25, 0.03), ("length", fit["length_mm"], 100, 0.01), ("axis", abs(fit["axis"][2]), 1, 1e-6),
    ("distance", apart["hausdorff_mm"], 0, 0.05), ("volume", apart["volume_mm3"] / apart["like_volume_mm3"], 1, 0.005),
    ("tube's volume", card("tube.vtp")["difference"]["volume_mm3"] / apart["like_volume_mm3"], 1, 0.002),
    ("area", area["wall.vtu"] / (100 * pi_d), 1, 0.01), ("area of the piece", area["piece.vtu"] / (60 * pi_d), 1, 0.01)]:
    if not abs(value - wanted) <= tolerance:
        raise SystemExit(f"{name}: {value}, not {wanted}")
if card("wall.vtu")["quality"]["worst"]["shortest_edge_mm"] > 2 or len(card("wall.vtu")["quality"]["worst_ten"]) != 10:
    raise SystemExit("no fine edges at the focus, or no ten worst")
PY

got=0; "$bin/palpate-mesh" cylinder.vtp bad.vtu --kind shell --thickness 13 --quiet 2>message || got=$?
if [ $got != 2 ] || ! grep -q "thicker than the tube's radius" message; then echo "a wall thicker than the radius: $got"; cat message; exit 1; fi
got=0; "$bin/palpate-mesh" cylinder.vtp bad.vtu --kind shell --cut-to 500 --quiet 2>message || got=$?
if [ $got != 2 ] || ! grep -q "beyond the centre line" message; then echo "a cut beyond the end: $got"; cat message; exit 1; fi

# thickness by place: a zone along the centre line, three circular folds, a polyp on one side
"$bin/palpate-mesh" cylinder.vtp zone.vtu $shell --zone 40,60,1.5
"$bin/palpate-mesh" cylinder.vtp folds.vtu $shell --zone 42,45,2 --zone 49,52,2 --zone 56,59,2 --zone-edge 1
"$bin/palpate-mesh" cylinder.vtp polyp.vtu $shell --polyp 0,11.8,50 --polyp-radius 5 --polyp-height 2
python3 - <<'PY'
import json
for name, wanted, less in (("zone", 1.4 * 1.5, 1e-12), ("folds", 2.8, 1e-12), ("polyp", 3.4, 0.2)):  # no node need lie in a polyp's very middle
    low, high = json.load(open(name + ".vtu.card.json"))["notes"]["thickness_mm"]
    if not (abs(low - 1.4) <= 1e-12 and wanted - less <= high <= wanted + 1e-12):
        raise SystemExit(f"{name}: from {low} to {high} mm, not to {wanted} mm")
PY
got=0; "$bin/palpate-mesh" cylinder.vtp bad.vtu $shell --zone 60,40,2 2>message || got=$?
if [ $got != 2 ] || ! grep -q "two places in mm, ascending" message; then echo "a zone the wrong way round is not told:"; cat message; exit 1; fi
got=0; "$bin/palpate-mesh" cylinder.vtp bad.vtu $shell --polyp 50,0,50 2>message || got=$?
if [ $got != 2 ] || ! grep -q "reaches no node" message; then echo "a polyp in the air is not told:"; cat message; exit 1; fi

# the wall measured from a label: outside a lumen of 19 mm, 1.5 mm thick on one side and 2.5 mm on the other, in voxels of half a millimetre
python3 - <<'PY'
import gzip, math, struct
n, m, h = 60, 121, 0.5
header = bytearray(348)
struct.pack_into("<i", header, 0, 348)
struct.pack_into("<8h", header, 40, 3, n, n, m, 1, 1, 1, 1)
struct.pack_into("<2h", header, 70, 2, 8)
struct.pack_into("<8f", header, 76, 1, h, h, h, 1, 1, 1, 1)
struct.pack_into("<f", header, 108, 352)
struct.pack_into("<2f", header, 112, 1, 0)
header[123] = 2
struct.pack_into("<2h", header, 252, 0, 1)
corner = -h * (n - 1) / 2
for row, values in enumerate(((h, 0, 0, corner), (0, h, 0, corner), (0, 0, h, 0))): struct.pack_into("<4f", header, 280 + 16 * row, *values)
header[344:348] = b"n+1\0"
voxels = bytearray()
for k in range(m):
    for j in range(n):
        for i in range(n):
            x, y = corner + h * i, corner + h * j  # RAS: y here is -y of the mesh
            r = math.hypot(x, y)
            voxels.append(1 if 9.5 <= r <= (12.0 if y > 0 else 11.0) else 0)
open("labels.nii.gz", "wb").write(gzip.compress(bytes(header) + bytes(4) + bytes(voxels)))
PY
"$bin/palpate-idealize" lumen.vtp --diameter 19 --length 60 --edge 1.2 --quiet
"$bin/palpate-mesh" lumen.vtp measured.vtu --kind shell --wall labels.nii.gz --offset 1 --quiet
python3 - <<'PY'
import json
notes = json.load(open("measured.vtu.card.json"))["notes"]
low, high = notes["thickness_mm"]
if not (abs(low - 1.5) <= 0.25 and abs(high - 2.5) <= 0.25 and notes["wall_label"]["nodes_filled_from_neighbours"] == 0):  # half a voxel
    raise SystemExit(f"from {low} to {high} mm, {notes['wall_label']}")
PY
got=0; "$bin/palpate-mesh" lumen.vtp bad.vtu --kind shell --wall labels.nii.gz --wall-label 7 --offset 1 --quiet 2>message || got=$?
if [ $got = 0 ] || ! grep -q "label" message || [ -e bad.vtu ]; then echo "a label that is not there: $got"; cat message; exit 1; fi
echo "cylinder fitted, cut, meshed, thickened and measured"
