# The patch of bench/calculix pressed into its block, by GetFEM: a third code for the force at 6 mm.
# SPDX-License-Identifier: GPL-3.0-or-later
"""A block of 40 x 40 x 20 mm, bottom held, a square patch of 20 x 20 mm of its top pushed down 6 mm and sticking: a quarter, quadratic displacements
and linear pressure on the structured tetrahedra of bench-quarter-block.

    /usr/bin/python3 bench/getfem/patch_on_block.py LAW RATIO POWER CELLS [CELLS ...]

LAW: neo_hookean, mooney_rivlin or yeoh; RATIO: bulk modulus over shear modulus; POWER: cells get finer towards the patch's edge (1: all alike); CELLS: in half
the patch, as many beside it, twice as many in depth. Prints cells, unknowns and the force in N (Renard and Poulios 2020, ACM Trans. Math. Softw. 47:4; Debian:
python3-getfem), and of the last three the limit for h -> 0 with its order. Numbers kept, not asserted.
"""
import sys

import getfem as gf
import numpy as np

SIDE, HALF, HEIGHT, DEPTH, STEPS = 20.0, 10.0, 20.0, 6.0, 6
LAWS = {"neo_hookean": (0.00335, 0.0, 0.0, 0.0), "mooney_rivlin": (0.083, 0.0, 0.0, 0.0565), "yeoh": (0.0034, 0.0012, 0.0005, 0.0)}  # C10, C20, C30, C01



def towards(end, cells, power):
    """Coordinates from 0 to `end`, finer there."""
    return end * (1 - (1 - np.linspace(0, 1, cells + 1)) ** power)


def faces_at(mesh, axis, value):
    faces = mesh.outer_faces()
    points = mesh.pts()
    keep = [k for k in range(faces.shape[1]) if np.all(np.abs(points[axis, mesh.pid_in_faces(faces[:, k : k + 1])] - value) < 1e-9)]
    return faces[:, keep]


def force(law, ratio, power, cells):
    c10, c20, c30, c01 = LAWS[law]
    across = np.concatenate([towards(HALF, cells, power), (SIDE - towards(SIDE - HALF, cells, power))[::-1][1:]])
    mesh = gf.Mesh("regular simplices", across, across, towards(HEIGHT, 2 * cells, power))
    points, top = mesh.pts(), faces_at(mesh, 2, HEIGHT)
    patch = [k for k in range(top.shape[1]) if np.all(points[:2, mesh.pid_in_faces(top[:, k : k + 1])] < HALF + 1e-9)]
    for region, faces in enumerate([faces_at(mesh, 2, 0.0), top[:, patch], faces_at(mesh, 0, 0.0), faces_at(mesh, 1, 0.0)], start=1):
        mesh.set_region(region, faces)
    u, p = gf.MeshFem(mesh, 3), gf.MeshFem(mesh, 1)
    u.set_classical_fem(2), p.set_classical_fem(1)
    inside = gf.MeshIm(mesh, gf.Integ("IM_TETRAHEDRON(5)"))
    model = gf.Model("real")
    model.add_fem_variable("u", u)
    model.add_fem_variable("p", p)
    for name, value in (("c10", c10), ("c20", c20), ("c30", c30), ("c01", c01), ("kappa", ratio * 2 * (c10 + c01))):
        model.add_initialized_data(name, [value])
    model.add_macro("F", "Id(3)+Grad_u")
    model.add_macro("C", "(F')*F")
    model.add_macro("I", "pow(Det(F),-2/3)*Norm_sqr(F)-3")
    model.add_macro("II", "pow(Det(F),-4/3)*(sqr(Norm_sqr(F))-Norm_sqr(C))/2-3")
    model.add_macro("W", "c10*I+c20*I*I+c30*I*I*I+c01*II")
    model.add_nonlinear_term(inside, "Diff(W,u,Test_u) + p*(Det(F)*Inv(F')):Grad_Test_u + (Det(F)-1-p/kappa)*Test_p")
    model.add_initialized_data("down", [0.0, 0.0, 0.0])
    model.add_Dirichlet_condition_with_simplification("u", 1)
    model.add_Dirichlet_condition_with_simplification("u", 2, "down")
    for region, axis in ((3, 0), (4, 1)):
        normal = np.zeros(3)
        normal[axis] = 1
        model.add_initialized_data(f"along{region}", np.outer(normal, normal))
        model.add_initialized_data(f"zero{region}", [0.0, 0.0, 0.0])
        model.add_generalized_Dirichlet_condition_with_multipliers(inside, "u", u, region, f"zero{region}", f"along{region}")
    for step in range(1, STEPS + 1):
        model.set_variable("down", [0.0, 0.0, -DEPTH * step / STEPS])
        model.solve("max_res", 1e-9, "max_iter", 30, "lsolver", "mumps", "lsearch", "simplest")
    forces = gf.asm_generic(inside, 1, "Diff(W,u,Test_u) + p*(Det(F)*Inv(F')):Grad_Test_u", -1, model).reshape(-1)
    first, count = model.interval_of_variable("u")
    on_patch = u.basic_dof_on_region(2)
    return -4 * forces[first : first + count][on_patch[on_patch % 3 == 2]].sum(), u.nbdof() + p.nbdof()


def limit(cells, forces):
    """Order and value for h -> 0 of the last three: (f0 - f1)/(f1 - f2) = (h0^p - h1^p)/(h1^p - h2^p), rising with p; None where no order fits."""
    if len(cells) < 3:
        return None
    h, f = 1 / np.array(cells[-3:], float), forces[-3:]
    of = lambda p: (h[0] ** p - h[1] ** p) / (h[1] ** p - h[2] ** p)
    ratio, low, high = (f[0] - f[1]) / (f[1] - f[2]), 0.2, 6.0
    if not of(low) < ratio < of(high):
        return None
    for _ in range(100):
        p = (low + high) / 2
        low, high = (p, high) if of(p) < ratio else (low, p)
    return p, f[2] - (f[1] - f[2]) * h[2] ** p / (h[1] ** p - h[2] ** p)


gf.util_trace_level(0)
law, ratio, power = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
cells, forces = [int(word) for word in sys.argv[4:]], []
for n in cells:
    newtons, unknowns = force(law, ratio, power, n)
    forces.append(newtons)
    print(f"{law}, kappa = {ratio:g} mu: {n} cells, {unknowns} unknowns: {newtons:.5f} N", flush=True)
if found := limit(cells, forces):
    print(f"order {found[0]:.2f}, limit {found[1]:.5f} N")
