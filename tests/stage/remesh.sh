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
assert notes["tets"]["after"] >= 6 * notes["tets"]["before"], notes["tets"]
assert abs(volume["after"] / volume["before"] - 1) <= 1e-12, volume  # round-off
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
{ cat case.toml; printf '[remesh]\npart_of_radius = 0.5\nfinest_mm = 2\n'; } >remesh.toml
printf '[[effect]]\nname = "prony"\ng = [0.4]\ntau_s = [0.5]\n[[effect]]\nname = "mullins"\ninverse_r = 0.5\nm = 0.0005\n' >effects
for name in case remesh; do cat $name.toml effects >$name-effects.toml; done

solve() { "$bin/palpate-solve" "$1.toml" "$2" --mesh "$3" --threads 1 --quiet </dev/null >/dev/null; }
last_mesh() { find "$1/remesh" -name 'mesh_*.vtu' | sort | tail -n 1; }
for kind in "" -effects; do
  solve case$kind coarse$kind block.vtu
  solve remesh$kind remeshed$kind block.vtu
  solve case$kind fine$kind "$(last_mesh remeshed$kind)"
done
solve remesh again block.vtu
diff -r remeshed again >/dev/null || fail "other bytes on a rerun"

python3 - <<'PY'
import json
for kind, same in (("", 1e-6), ("-effects", 1e-3)):
    coarse, remeshed, fine = (json.load(open(f"{name}{kind}/summary.json")) for name in ("coarse", "remeshed", "fine"))
    assert "remeshings" not in coarse
    all_of_them = remeshed["remeshings"]
    assert len(all_of_them) >= 2, all_of_them
    first = all_of_them[0]["volume_mm3"]["before"]
    for r in all_of_them:
        volume, force = r["volume_mm3"], r["force_N"]
        print(f"{kind} {r['time_s']:.3f} s, {r['nodes']} nodes: force {force['before']:.6f} -> {force['after']:.6f} N, volume {volume['before']:.4f} carried {volume['carried']:.4f} after {volume['after']:.4f} mm3")
        assert abs(volume["carried"] / volume["before"] - 1) <= 1e-10, r  # round-off
        assert abs(volume["after"] / first - 1) <= 2e-3, r
    f = [x["final_force_N"] for x in (coarse, remeshed, fine)]
    print(f"{kind} force: coarse {f[0]}, remeshed {f[1]} ({f[1] / f[0] - 1:+.2%}), on its last mesh from the beginning {f[2]} ({f[1] / f[2] - 1:+.1e})")
    assert abs(f[1] / f[2] - 1) <= same, f
PY
