#!/usr/bin/env bash
# palpate-remesh by itself, and a solve that calls it: a ball pressed into a coarse block goes on, on a mesh that suits it, with the force of a run
# on that mesh from the beginning.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() { echo "$1" >&2; exit 1; }

"$bin/test-block" block.vtu 4 2 2 4 8
"$bin/palpate-remesh" block.vtu finer.vtu --quiet >/dev/null
python3 - <<'PY'
import json
notes = json.load(open("finer.vtu.card.json"))["notes"]
volume = notes["volume_mm3"]
print(notes["tets"], notes["nodes"], notes["quality"]["scaled_jacobian"]["min"])
assert notes["tets"]["after"] >= 3 * notes["tets"]["before"], notes["tets"]
assert abs(volume["after"] / volume["before"] - 1) <= 1e-12, volume  # round-off
PY

# A core of 12 mm diameter cut out of the block, from top to bottom.
"$bin/palpate-idealize" knife.vtp --diameter 12 --length 60 --edge 1 --quiet
"$bin/palpate-remesh" block.vtu cored.vtu --cut knife.vtp --quiet >/dev/null
python3 - <<'PY'
import json, math
notes = json.load(open("cored.vtu.card.json"))["notes"]
print(notes["cut"], notes["volume_mm3"], notes["quality"]["scaled_jacobian"]["min"])
assert notes["cut"]["components"] == {"before": 1, "after": 2}, notes["cut"]
assert abs(notes["volume_mm3"]["after"] / notes["volume_mm3"]["before"] - 1) <= 2e-3
assert abs(notes["cut"]["lip_area_mm2"] / (math.pi * 12 * 20) - 1) <= 0.05, notes["cut"]  # flat faces of 4 mm cells
PY
cat >case.toml <<'TOML'
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
axis = [0.0, 0.0, -1.0]
depth_mm = 4.0
speed_mm_s = 4.0
[steps]
count = 6
frames = 3
TOML
{ cat case.toml; printf '[remesh]\npart_of_radius = 0.4\npart_of_contact = 1\nfinest_mm = 2\n'; } >remesh.toml
printf '[[effect]]\nname = "prony"\ng = [0.4]\ntau_s = [0.5]\n[[effect]]\nname = "mullins"\ninverse_r = 0.5\nm = 0.0005\n' >effects
for name in case remesh; do cat $name.toml effects >$name-effects.toml; done

solve() { "$bin/palpate-solve" "$1.toml" "$2" --mesh "$3" --threads 1 --quiet </dev/null >/dev/null; }
last_mesh() { find "$1/remesh" -name 'mesh_*.vtu' | sort | tail -n 1; }
solve case coarse block.vtu
for kind in "" -effects; do
  solve remesh$kind remeshed$kind block.vtu
  solve case$kind fine$kind "$(last_mesh remeshed$kind)"
done

# A finer mesh that would be too large is refused once, and asked for no more: the run ends as without.
{ cat remesh.toml; printf 'most_nodes = 406\n'; } >small.toml
"$bin/palpate-solve" small.toml small --mesh block.vtu --threads 1 </dev/null >/dev/null 2>message
[ "$(grep -c "a finer mesh would have more than 406 nodes" message)" = 1 ] || fail "not refused once for its size: $(cat message)"
cmp -s small/history.csv coarse/history.csv || fail "a refused remeshing changes the run"

# No tool, but elements that lose their shape: a block pulled by its whole top is made finer for that reason, and for no other.
"$bin/test-block" tall.vtu 5 4 0 4 20
sed '/^\[tool\]/,$d' case.toml >pull.toml
cat >>pull.toml <<'TOML'
[[displacement]]
box = { min_mm = [-20.1, -20.1, 19.9], max_mm = [20.1, 20.1, 20.1] }
motion_mm = [0.0, 0.0, 20.0]
[steps]
count = 4
frames = 1
TOML
for least in 0.4 0; do
  { cat pull.toml; printf '[remesh]\nfinest_mm = 4\nmost = 1\nleast_shape = %s\n' $least; } >pull-$least.toml
  solve pull-$least pulled-$least tall.vtu
done
solve pull pulled "$(last_mesh pulled-0.4)"
python3 - <<'PY'
import json
marked, unmarked, fine = (json.load(open(f"{name}/summary.json")) for name in ("pulled-0.4", "pulled-0", "pulled"))
for r in marked["remeshings"]:
    print(r["time_s"], r["why"], r["nodes"], r["least_shape"], r["force_N"])
    assert r["why"] == "elements had lost their shape", r
    assert r["least_shape"]["before"] < 0.4, r
assert "remeshings" not in unmarked
assert abs(marked["final_force_N"] / fine["final_force_N"] - 1) <= 1e-6, (marked["final_force_N"], fine["final_force_N"])
PY

# Killed after its first remeshing and given again: the same bytes.
"$bin/palpate-solve" remesh-effects.toml again --mesh block.vtu --threads 1 --quiet </dev/null >/dev/null &
pid=$!
for _ in $(seq 600); do
  if [ -f .partial-$pid-again/restart.bin ] && [ -f .partial-$pid-again/frames/frame_0001.vtu ]; then break; fi
  sleep 0.1
done
kill -9 $pid || fail "the run ended before it could be killed"
wait $pid 2>/dev/null || true
[ -f .partial-$pid-again/remesh/mesh_01.vtu ] || fail "it was killed before it had remeshed"
"$bin/palpate-solve" remesh-effects.toml again --mesh block.vtu --threads 1 </dev/null >/dev/null 2>message
grep -q "continues a run that was killed" message || fail "does not go on: $(cat message)"
diff -r remeshed-effects again >/dev/null || fail "other bytes after a kill"

python3 - <<'PY'
import csv, json
for kind, same in (("", 1e-6), ("-effects", 1e-3)):
    remeshed, fine = (json.load(open(f"{name}{kind}/summary.json")) for name in ("remeshed", "fine"))
    all_of_them = remeshed["remeshings"]
    assert len(all_of_them) >= 2, all_of_them
    first = all_of_them[0]["volume_mm3"]["before"]
    for r in all_of_them:
        volume, force = r["volume_mm3"], r["force_N"]
        print(f"{kind} {r['time_s']:.3f} s, {r['nodes']} nodes: force {force['before']:.6f} -> {force['after']:.6f} N, volume {volume['before']:.4f} carried {volume['carried']:.4f} after {volume['after']:.4f} mm3")
        assert abs(volume["carried"] / volume["before"] - 1) <= 1e-10, r  # round-off
        assert abs(volume["after"] / first - 1) <= 2e-3, r
    at_first = [float(row["F[N]"]) for row in csv.DictReader(open(f"remeshed{kind}/history.csv")) if abs(float(row["t[s]"]) - all_of_them[0]["time_s"]) <= 1e-9]
    assert abs(at_first[0] / all_of_them[0]["force_N"]["after"] - 1) <= 1e-9, (at_first, all_of_them[0])  # the history has what the finer mesh says
    f = [x["final_force_N"] for x in (remeshed, fine)]
    print(f"{kind} force: remeshed {f[0]}, on its last mesh from the beginning {f[1]} ({f[0] / f[1] - 1:+.1e})")
    assert abs(f[0] / f[1] - 1) <= same, f
coarse = json.load(open("coarse/summary.json"))
assert "remeshings" not in coarse
print(f"force on the coarse mesh {coarse['final_force_N']}")
PY

# Sensitivities through a remeshing, against central differences of whole runs: to 1e-4 of the largest (issue 3).
cat remesh-effects.toml | sed 's/^depth_mm.*/depth_mm = 2.0/; s/^count.*/count = 4/' >base.toml
"$bin/palpate-solve" base.toml base --mesh block.vtu --threads 1 --quiet --sensitivities "material.mu, effect[0].g[0], tool.aim_mm[2]" </dev/null >/dev/null
for change in mu g; do
  for sign in + -; do
    case $change in
      mu) sed "s/^mu = .*/mu = $(python3 -c "print(0.005 * (1 $sign 1e-3))")/" base.toml ;;
      g) sed "s/^g = .*/g = [$(python3 -c "print(0.4 $sign 1e-4)")]/" base.toml ;;
    esac >moved.toml
    "$bin/palpate-solve" moved.toml "moved-$change$sign" --mesh block.vtu --threads 1 --quiet </dev/null >/dev/null
  done
done
python3 - <<'PY'
import csv, json
def column(path, name):
    rows = list(csv.DictReader(open(path)))
    return [float(r[name]) for r in rows]
assert json.load(open("base/summary.json"))["remeshings"]
for change, path, step in (("mu", "material.mu", 0.005e-3), ("g", "effect[0].g[0]", 1e-4)):
    for sign in "+-":
        cmp = [open(f"{name}/remesh/mesh_01.vtu", "rb").read() for name in ("base", f"moved-{change}{sign}")]
        assert cmp[0] == cmp[1], "another mesh"
    said = column("base/sensitivities.csv", f"dF/d({path})")
    up, down = (column(f"moved-{change}{sign}/history.csv", "F[N]") for sign in "+-")
    found = [(a - b) / (2 * step) for a, b in zip(up, down)]
    worst = max(abs(a - b) for a, b in zip(said, found)) / max(map(abs, found))
    print(f"dF/d({path}): {said[-1]:.6g}, by whole runs {found[-1]:.6g}, worst {worst:.1e} of the largest")
    assert worst <= 1e-4, (said, found)
PY
