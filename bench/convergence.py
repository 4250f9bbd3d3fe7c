# How well a force and a curve are known: one indentation on finer and finer meshes, and with smaller and smaller steps.
# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball of 4 mm pressed 2 mm into the block of bench/getfem (16 x 16 x 8 mm, neo-Hookean, incompressible): force at every quarter of a millimetre, what
each mesh misses of the finest in force and, after the best scaling, in the curve's shape; on the first mesh the same for 2, 4, 8 … steps to a report.

    python3 bench/convergence.py BIN FOLDER MESH [MESH ...]      meshes from coarse to fine, e.g. those that bench/getfem leaves in its folder
"""
import csv
import pathlib
import subprocess
import sys

DEPTH, REPORTS = 2.0, 8


def forces(bin_folder, folder, mesh, name, per_report=1, friction=0.0):
    case = folder / f"{name}.toml"
    case.write_text(f"""schema = "palpate-case/1"
[material]
law = "neo_hookean"
mu = 0.0067
[base]
plane = {{ point_mm = [0, 0, 1e-6], normal = [0, 0, 1] }}
[tool]
kind = "ball"
radius_mm = 4.0
aim_mm = [0, 0, 0]
axis = [0, 0, -1]
depth_mm = {DEPTH}
friction = {friction}
[steps]
count = {REPORTS * per_report}
frames = 1
""")
    subprocess.run([str(word) for word in (bin_folder / "palpate-solve", case, folder / name, "--mesh", mesh, "--quiet", "--force")], check=True,
                   stdout=subprocess.DEVNULL)
    rows = list(csv.DictReader(open(folder / name / "history.csv")))
    return [float(row["F[N]"]) for row in rows][::per_report][1:]


def told(name, curve, finest):
    scale = sum(a * b for a, b in zip(curve, finest)) / sum(a * a for a in curve)
    shape = max(abs(scale * a - b) for a, b in zip(curve, finest)) / max(finest)
    misses = " ".join(f"{100 * (a / b - 1):+7.2f}" for a, b in zip(curve, finest))
    print(f"{name:<28} {misses}   shape {100 * shape:.2f} %", flush=True)


def main():
    bin_folder, folder, meshes = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), [pathlib.Path(word).resolve() for word in sys.argv[3:]]
    folder.mkdir(parents=True, exist_ok=True)
    print(f"{'% of the finest, at mm':<28} " + " ".join(f"{DEPTH * (i + 1) / REPORTS:7.2f}" for i in range(REPORTS)))
    curves = [forces(bin_folder, folder, mesh, f"mesh_{i}") for i, mesh in enumerate(meshes)]
    for mesh, curve in zip(meshes, curves):
        told(mesh.stem, curve, curves[-1])
    print("finest, N                    " + " ".join(f"{f:7.5f}" for f in curves[-1]))
    for friction in (0.0, 0.3):
        counts = (1, 2, 4, 8)
        runs = [forces(bin_folder, folder, meshes[0], f"steps_{friction}_{n}", n, friction) for n in counts]
        for n, run in zip(counts, runs):
            told(f"friction {friction}, {n * REPORTS} steps", run, runs[-1])


main()
