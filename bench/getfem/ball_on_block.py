# A ball pressed into a bonded block, frictionless and incompressible, by palpate-solve and by GetFEM: forces side by side.
# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball of 4 mm radius pressed 2 mm into a block of 16 x 16 x 8 mm, bonded below: neo-Hookean, incompressible, frictionless, finite strain.

    /usr/bin/python3 bench/getfem/ball_on_block.py BIN FOLDER [EDGE_MM ...]

BIN: the folder of the executables. FOLDER: meshes, cases and table.csv. EDGE_MM: element sizes of palpate-mesh under the ball (default 0.8 0.55 0.4).
GetFEM (Renard and Poulios 2020, ACM Trans. Math. Softw. 47:4; Debian: python3-getfem) solves a quarter with quadratic displacements, linear pressure
and quadratic contact multipliers (Alart and Curnier 1991) on structured tetrahedra of two sizes. Numbers kept, not asserted.
"""
import csv
import pathlib
import subprocess
import sys

import getfem as gf
import numpy as np

MU, RADIUS, HALF, HEIGHT = 0.0067, 4.0, 8.0, 8.0
DEPTHS = [0.25 * i for i in range(1, 9)]


def getfem_forces(cells):
    """Force (N) at every depth; `cells` along half an edge of the block."""
    grade = np.linspace(0, 1, cells + 1)
    side = HALF * (0.55 * grade + 0.45 * grade**2.5)                                 # finer under the ball
    up = HEIGHT * (1 - (0.55 * grade + 0.45 * grade**2.0))[::-1]
    mesh = gf.Mesh("regular simplices", side, side, up)
    for region, (axis, value) in enumerate([(2, 0.0), (2, HEIGHT), (0, 0.0), (1, 0.0)], start=1):
        mesh.set_region(region, faces_at(mesh, axis, value))
    u, p, c = gf.MeshFem(mesh, 3), gf.MeshFem(mesh, 1), gf.MeshFem(mesh, 1)
    u.set_classical_fem(2), p.set_classical_fem(1), c.set_classical_fem(2)  # linear contact pressures let the surface wrinkle
    inside = gf.MeshIm(mesh, gf.Integ("IM_TETRAHEDRON(5)"))
    model = gf.Model("real")
    model.add_fem_variable("u", u)
    model.add_fem_variable("p", p)
    model.add_filtered_fem_variable("contact", c, 2)
    for name, value in (("mu", MU), ("r", 0.1), ("R", RADIUS), ("depth", 0.0)):
        model.add_initialized_data(name, [value])
    model.add_macro("F", "Id(3)+Grad_u")
    model.add_nonlinear_term(inside, "(mu*pow(Det(F),-2/3)*(F-Norm_sqr(F)/3*Inv(F')) + p*Det(F)*Inv(F')):Grad_Test_u + (Det(F)-1)*Test_p")
    model.add_macro("from_centre", f"X+u-[0;0;{HEIGHT}+R-depth]")
    model.add_macro("gap", "Norm(from_centre)-R")
    model.add_nonlinear_term(inside, "-contact*(Normalized(from_centre).Test_u) + (contact-pos_part(contact-r*gap))*Test_contact/r", 2)
    model.add_Dirichlet_condition_with_simplification("u", 1)
    for region, normal in ((3, [1, 0, 0]), (4, [0, 1, 0])):
        name = f"along{region}"
        model.add_initialized_data(name, np.outer(normal, normal))
        model.add_initialized_data(name + "_zero", [0, 0, 0])
        model.add_generalized_Dirichlet_condition_with_multipliers(inside, "u", u, region, name + "_zero", name)
    forces = []
    for depth in DEPTHS:
        model.set_variable("depth", [depth])
        model.solve("max_res", 1e-8, "max_iter", 40, "lsolver", "mumps", "lsearch", "simplest")
        up_force = gf.asm_generic(inside, 0, "contact*(Normalized(from_centre).[0;0;1])", 2, model)
        forces.append(-4 * up_force)
        print(f"  GetFEM {cells} cells: {depth:.2f} mm {forces[-1]:.6f} N", flush=True)
    return forces, u.nbdof() + p.nbdof()


def faces_at(mesh, axis, value):
    faces = mesh.outer_faces()
    keep = []
    for k in range(faces.shape[1]):
        points = mesh.pts()[:, mesh.pid_in_faces(faces[:, k : k + 1])]
        if np.all(np.abs(points[axis] - value) < 1e-9):
            keep.append(k)
    return faces[:, keep]


def box_stl(path):
    """The block, as a triangle surface with 2 mm faces."""
    n = 8
    def grid(origin, a, b):
        for i in range(n):
            for j in range(n):
                q = [origin + a * (i + di) / n + b * (j + dj) / n for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))]
                yield q[0], q[1], q[2]
                yield q[0], q[2], q[3]
    o, x, y, z = np.array([-HALF, -HALF, 0.0]), np.array([2 * HALF, 0, 0]), np.array([0, 2 * HALF, 0]), np.array([0, 0, HEIGHT])
    sides = [(o, y, x), (o + z, x, y), (o, x, z), (o + y, z, x), (o, z, y), (o + x, y, z)]
    with open(path, "w") as f:
        f.write("solid block\n")
        for side in sides:
            for triangle in grid(*side):
                f.write("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.9g %.9g %.9g\n" % tuple(p) for p in triangle) + "endloop\nendfacet\n")
        f.write("endsolid block\n")


def palpate_forces(bin_folder, folder, edge):
    surface = folder / "block.vtp"
    mesh, case = folder / f"block_{edge}.vtu", folder / f"block_{edge}.toml"
    run = lambda *words: subprocess.run([str(w) for w in words], check=True)
    run(bin_folder / "palpate-surface", folder / "block.stl", surface, "--edge", 1.5, "--quiet", "--force")
    run(bin_folder / "palpate-mesh", surface, mesh, "--edge", 2.0, f"--focus=0,0,{HEIGHT}", "--focus-edge", edge, "--focus-radius", 4.0, "--quiet", "--force")
    case.write_text(f"""schema = "palpate-case/1"
mesh = "{mesh.name}"
[material]
law = "neo_hookean"
mu = {MU}
[base]
plane = {{ point_mm = [0, 0, 1e-6], normal = [0, 0, 1] }}
[tool]
kind = "ball"
radius_mm = {RADIUS}
aim_mm = [0, 0, 0]
axis = [0, 0, -1]
depth_mm = {DEPTHS[-1]}
[steps]
count = {len(DEPTHS)}
frames = 1
""")
    run(bin_folder / "palpate-solve", case, folder / f"result_{edge}", "--quiet", "--force")
    rows = list(csv.DictReader(open(folder / f"result_{edge}" / "history.csv")))
    return [float(row["F[N]"]) for row in rows[1:]]


def main():
    bin_folder, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    box_stl(folder / "block.stl")
    columns = {}
    for edge in [float(word) for word in sys.argv[3:]] or [0.8, 0.55, 0.4]:
        columns[f"palpate_{edge}_mm[N]"] = palpate_forces(bin_folder, folder, edge)
    for cells in (7, 10):
        columns[f"getfem_{cells}_cells[N]"] = getfem_forces(cells)[0]
    with open(folder / "table.csv", "w") as f:
        csv.writer(f).writerows([["depth[mm]", *columns]] + [[d] + [f"{c[i]:.6g}" for c in columns.values()] for i, d in enumerate(DEPTHS)])
    print((folder / "table.csv").read_text(), end="")


main()
