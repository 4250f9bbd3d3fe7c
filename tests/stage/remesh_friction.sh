#!/usr/bin/env bash
# Friction goes on over a remeshing: under a ball that comes at a slant, and between two blocks, one pressed on the other and dragged. Where the mesh gets
# finer while it slides, the pull is that of a run on the finer mesh from the beginning.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() { echo "$1" >&2; exit 1; }
solve() { "$bin/palpate-solve" "$1.toml" "$2" --mesh "$3" --threads 1 --quiet </dev/null >/dev/null; }

"$bin/test-block" block.vtu 4 2 2 4 8
cat >ball.toml <<'TOML'
schema = "palpate-case/1"
[material]
law = "neo_hookean"
mu = 0.005
[base]
plane = { point_mm = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }
[tool]
kind = "ball"
radius_mm = 8.0
aim_mm = [0.3, 0.2, 20.0]
axis = [0.8, 0.1, -0.6]
friction = 0.2
path = [[0, 0], [0.25, 1]]
[steps]
count = 2
TOML
{ cat ball.toml; printf '[remesh]\npart_of_radius = 0.4\npart_of_contact = 1\nfinest_mm = 2\n'; } >ball-finer.toml

PYTHONPATH=$here python3 -B - <<'PY'
from two_blocks import block, write
block((-6, -6, 0), (14, 12, 5), (7, 6, 3), 1)
block((-3, -3, 5), (6, 6, 4), (3, 3, 2), 2)
write("two.vtu")
PY
cat >blocks.toml <<'TOML'
schema = "palpate-case/1"
[[material]]
region = "lower"
law = "neo_hookean"
mu = 0.05
[[material]]
region = "upper"
law = "neo_hookean"
mu = 0.0067
[base]
plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }
[[contact]]
between = ["lower", "upper"]
friction = 0.2
[[displacement]]
plane = { point_mm = [0.0, 0.0, 8.99], normal = [0.0, 0.0, -1.0] }
motion_mm = [1.6, 0.2, -0.4]
[steps]
count = 16
frames = 8
TOML
{ cat blocks.toml; printf '[remesh]\nleast_shape = 0.9\nfinest_mm = 1.0\nmost = 1\n'; } >blocks-finer.toml

solve ball-finer ball-finer block.vtu
solve ball ball ball-finer/remesh/mesh_01.vtu
solve blocks-finer blocks-finer two.vtu
solve blocks blocks blocks-finer/remesh/mesh_01.vtu
python3 - <<'PY'
import csv, json, math
def rows(name):
    for r in csv.DictReader(open(f"{name}/history.csv")):
        x, y, z = (float(r[f"F{c}[N]"]) for c in "xyz")
        yield float(r["t[s]"]), math.hypot(x, y), -z
# At the remeshing, and at the end: of the pull, then of the press. The coarse mesh's way there is another one.
for name, there, at_end in (("ball", 0.01, 0.002), ("blocks", 0.02, 0.002)):
    summary = json.load(open(f"{name}-finer/summary.json"))
    assert summary["worst_force_imbalance"] <= 1e-9, summary["worst_force_imbalance"]
    assert name == "ball" or summary["worst_energy_imbalance"] <= 0.01, summary["worst_energy_imbalance"]  # two steps of the ball are too few
    time = summary["remeshings"][0]["time_s"]
    pairs = [(t, pull / fine_pull - 1, press / fine_press - 1) for (t, pull, press), (_, fine_pull, fine_press) in zip(rows(f"{name}-finer"), rows(name)) if t >= time - 1e-9]
    for t, pull, press in pairs:
        print(f"{name} {t:.3f} s: pull {pull:+.2e}, press {press:+.2e} off a run on the finer mesh; imbalance {summary['worst_force_imbalance']:.1e}, of energy {summary['worst_energy_imbalance']:.1e}")
    assert pairs[0][0] < pairs[-1][0]
    for limit, (t, pull, press) in ((there, pairs[0]), (at_end, pairs[-1])):
        assert abs(pull) <= limit and abs(press) <= limit, (name, t, pull, press)
PY

# Killed after its remeshing and given again: the same bytes.
"$bin/palpate-solve" blocks-finer.toml again --mesh two.vtu --threads 1 --quiet </dev/null >/dev/null &
pid=$!
while kill -0 $pid 2>/dev/null; do
  if [ -f .partial-$pid-again/remesh/mesh_01.vtu ] && [ .partial-$pid-again/restart.bin -nt .partial-$pid-again/remesh/mesh_01.vtu ]; then break; fi
  sleep 0.02
done
kill -9 $pid || fail "the run ended before it could be killed"
wait $pid 2>/dev/null || true
"$bin/palpate-solve" blocks-finer.toml again --mesh two.vtu --threads 1 </dev/null >/dev/null 2>message
grep -q "continues a run that was killed" message || fail "does not go on: $(cat message)"
diff -r blocks-finer again >/dev/null || fail "other bytes after a kill"
