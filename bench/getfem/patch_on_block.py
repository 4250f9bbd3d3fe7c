# The block of bench/calculix pushed down over its whole top, by GetFEM: a third code for the force at 6 mm.
# SPDX-License-Identifier: GPL-3.0-or-later
"""A block of 40 x 40 x 20 mm, bottom held, whole top pushed down 6 mm and sticking, kappa = 100 mu: a quarter, quadratic displacements and linear
pressure on structured tetrahedra that get smaller towards the edges, where stress is singular; or all alike, as bench/calculix has them.

    /usr/bin/python3 bench/getfem/patch_on_block.py LAW [uniform] CELLS [CELLS ...]      LAW: neo_hookean, mooney_rivlin or yeoh; CELLS: along 20 mm

Prints cells, unknowns and the force in N (Renard and Poulios 2020, ACM Trans. Math. Softw. 47:4; Debian: python3-getfem). Numbers kept, not asserted.
"""
import sys

import getfem as gf
import numpy as np

SIDE, HEIGHT, DEPTH, STEPS = 20.0, 20.0, 6.0, 6
LAWS = {"neo_hookean": (0.00335, 0.0, 0.0, 0.0), "mooney_rivlin": (0.083, 0.0, 0.0, 0.0565), "yeoh": (0.0034, 0.0012, 0.0005, 0.0)}  # C10, C20, C30, C01


POWER = 1.0 if "uniform" in sys.argv else 2.0


def towards(end, cells, power=POWER):
    """Coordinates from 0 to `end`, finer there."""
    return end * (1 - (1 - np.linspace(0, 1, cells + 1)) ** power)


def towards_both(height, cells):
    half = towards(height / 2, cells // 2)
    return np.concatenate([height / 2 - half[::-1], height / 2 + half[1:]])


def faces_at(mesh, axis, value):
    faces = mesh.outer_faces()
    points = mesh.pts()
    keep = [k for k in range(faces.shape[1]) if np.all(np.abs(points[axis, mesh.pid_in_faces(faces[:, k : k + 1])] - value) < 1e-9)]
    return faces[:, keep]


def force(law, cells):
    c10, c20, c30, c01 = LAWS[law]
    mesh = gf.Mesh("regular simplices", towards(SIDE, cells), towards(SIDE, cells), towards_both(HEIGHT, cells))
    for region, (axis, value) in enumerate([(2, 0.0), (2, HEIGHT), (0, 0.0), (1, 0.0)], start=1):
        mesh.set_region(region, faces_at(mesh, axis, value))
    u, p = gf.MeshFem(mesh, 3), gf.MeshFem(mesh, 1)
    u.set_classical_fem(2), p.set_classical_fem(1)
    inside = gf.MeshIm(mesh, gf.Integ("IM_TETRAHEDRON(5)"))
    model = gf.Model("real")
    model.add_fem_variable("u", u)
    model.add_fem_variable("p", p)
    for name, value in (("c10", c10), ("c20", c20), ("c30", c30), ("c01", c01), ("kappa", 100 * 2 * (c10 + c01))):
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
    # Virtual work of the stress on a field that is one over the top: the force of the top, whatever the field is inside.
    stress = f"(Diff(W,u,[0;0;X(3)/{HEIGHT}]) + p*(Det(F)*Inv(F')):[[0,0,0],[0,0,0],[0,0,1/{HEIGHT}]])"
    return -4 * gf.asm_generic(inside, 0, stress, -1, model), u.nbdof() + p.nbdof()


gf.util_trace_level(0)
for cells in [int(word) for word in sys.argv[2:] if word != "uniform"]:
    newtons, unknowns = force(sys.argv[1], cells)
    print(f"{sys.argv[1]} {cells} cells, {unknowns} unknowns: {newtons:.5f} N", flush=True)
