# Elastic curves of a pressed layer by GetFEM, axisymmetric: what make.py's sets rest on. Rewrites curves.csv beside this file.
# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball pressed into a bonded layer 20 mm high and 80 mm in radius, finite strain, frictionless: force over depth.

    /usr/bin/python3 bench/hidden/curves.py [NAME ...]

NAME: rows to compute anew (default all of CASES). GetFEM (Renard and Poulios 2020, ACM Trans. Math. Softw. 47:4; Debian: python3-getfem): biquadratic displacements and
contact pressures, bilinear pressures, F = 1 + diag(du/dr, u/r, du/dz); contact pressures by Alart and Curnier 1991. Linear contact pressures let the surface
wrinkle under the ball, which took 4 % of the force at a fifth of the height. Cells of a tenth and of a twentieth of the ball's radius give forces that agree
to 0.1 % (0.7 % where the contact radius is a fifth of the ball's). A converged step is asked for; what does not converge is an error.
"""
import csv
import pathlib
import sys

MU, HEIGHT, SIDE = 0.01, 20.0, 80.0  # MPa, mm
NEO_HOOKE = "mu/2*(pow(J,-2/3)*I1-3)"
TABLE = pathlib.Path(__file__).with_name("curves.csv")
# Effect, amplitudes, radii of the ball (mm). Depths: to nine tenths of the larger ball's radius, to 1.2 of the smaller one's.
CASES = {"none": ([0], [5.0, 2.5]), "thickness": ([-0.3, -0.2, -0.1, -0.05], [5.0, 2.5]), "compressibility": ([0.005, 0.02, 0.05, 0.1], [5.0, 2.5]),
         "stiffening": ([0.25, 0.5, 1.0, 2.0], [5.0, 2.5]), "inclusion": ([0.5, 1.0, 2.0, 4.0], [5.0]), "capsule": ([0.005, 0.01, 0.02, 0.05], [5.0, 2.5]),
         "support": ([0.5, 1.0, 2.0, 4.0, 8.0], [5.0, 2.5]),
         "narrow": ([30, 20], [5.0, 2.5]), "height": ([8, 12], [5.0, 2.5])}


def graded(first, even, end):
    """Equal steps up to `even`, then growing by 1.3, stretched to `end`."""
    places, step = [0.0], first
    while places[-1] < end - 1e-9:
        places.append(places[-1] + step)
        step *= 1.3 if places[-1] > even else 1
    return [p * end / places[-1] for p in places]


def layer_model(gf, np, radius, effect, amplitude, cells_per_radius=10):
    """Model, method of integration, mesh and displacements. Amplitudes: share of the height; 1/2 - Poisson's ratio; Demiray's b; excess stiffness of a ball of 5 mm
    radius 7 mm under the surface; E h of a skin, N/mm; softness of a bed under the layer, mm of a column at 1 MPa over the layer's own 1/(3 MU) per mm; radius of a cylinder instead of SIDE, mm; height instead of HEIGHT."""
    h = amplitude if effect == "height" else HEIGHT * (1 + (amplitude if effect == "thickness" else 0))
    first = radius / cells_per_radius
    mesh = gf.Mesh("cartesian", np.array(graded(first, 1.3 * radius, amplitude if effect == "narrow" else SIDE)), h - np.array(graded(first, 0.8 * radius, h))[::-1])
    for region, (axis, value) in enumerate([(1, 0.0), (1, h), (0, 0.0)], start=1):
        faces = mesh.outer_faces()
        keep = [k for k in range(faces.shape[1]) if np.all(abs(mesh.pts()[:, mesh.pid_in_faces(faces[:, k : k + 1])][axis] - value) < 1e-9)]
        mesh.set_region(region, faces[:, keep])
    u, p, c = gf.MeshFem(mesh, 2), gf.MeshFem(mesh, 1), gf.MeshFem(mesh, 1)
    u.set_classical_fem(2), p.set_classical_fem(1), c.set_classical_fem(2)
    inside = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,5)"))
    model = gf.Model("real")
    model.add_fem_variable("u", u)
    model.add_fem_variable("p", p)
    model.add_filtered_fem_variable("contact", c, 2)
    for name, value in (("mu", MU), ("r", 0.1), ("R", radius), ("depth", 0.0), ("a", amplitude), ("nu", 0.3)):
        model.add_initialized_data(name, [value])
    model.add_macro("F", "[1+Grad_u(1,1),0,Grad_u(1,2);0,1+u(1)/X(1),0;Grad_u(2,1),0,1+Grad_u(2,2)]")
    model.add_macro("J", "Det(F)")
    model.add_macro("I1", "Norm_sqr(F)")
    model.add_macro("w", "2*pi*X(1)")
    energy, volume = NEO_HOOKE, "p*(J-1)"
    if effect == "stiffening":
        energy = "mu/(2*a)*(exp(a*(pow(J,-2/3)*I1-3))-1)"
    if effect == "compressibility":
        nu = 0.5 - amplitude
        volume += f"-p*p/(2*{2 * MU * (1 + nu) / (3 * (1 - 2 * nu))!r})"
    if effect == "inclusion":
        energy = f"(1+a/2*(1+tanh(4*(5-Norm(X-[0;{h - 7!r}])))))*{NEO_HOOKE}"
    model.add_nonlinear_term(inside, f"w*({energy}+{volume})")
    if effect == "capsule":  # Saint Venant-Kirchhoff membrane; the surface is flat at rest
        model.add_macro("er", "(sqr(1+Grad_u(1,1))+sqr(Grad_u(2,1))-1)/2")
        model.add_macro("et", "(sqr(1+u(1)/X(1))-1)/2")
        model.add_nonlinear_term(inside, "w*a/(2*(1-0.25))*(sqr(er)+sqr(et)+er*et)", 2)
    if effect == "support":
        model.add_nonlinear_term(inside, "w*3*mu/(2*a)*Norm_sqr(u)", 1)
    else:
        model.add_Dirichlet_condition_with_simplification("u", 1)
    model.add_macro("apart", f"X+u-[0;{h!r}+R-depth]")
    model.add_macro("gap", "Norm(apart)-R")
    model.add_nonlinear_term(inside, "w*(-contact*(Normalized(apart).Test_u)+(contact-pos_part(contact-r*gap))*Test_contact/r)", 2)
    model.add_initialized_data("H", np.array([[1, 0], [0, 0]]))
    model.add_initialized_data("zero", [0, 0])
    model.add_generalized_Dirichlet_condition_with_multipliers(inside, "u", u, 3, "zero", "H")
    return model, inside, mesh, u


def pressed(model, radius, height):
    """The model at one depth after the other, mm."""
    deepest = min(4.6 if radius == 5 else 3.0, 0.3 * height)
    for share in (0.02, 0.05, 0.1, 0.17, 0.25, 0.33, 0.42, 0.5, 0.58, 0.67, 0.75, 0.83, 0.92, 1.0):
        model.set_variable("depth", [share * deepest])
        _, converged = model.solve("max_res", 1e-9, "max_iter", 60, "lsolver", "mumps", "lsearch", "simplest")
        if not converged:
            raise SystemExit(f"ball of {radius} mm: no equilibrium at {share * deepest} mm")
        yield round(share * deepest, 6)


def curve(gf, np, radius, effect, amplitude):
    model, inside, _, _ = layer_model(gf, np, radius, effect, amplitude)
    rows = []
    for depth in pressed(model, radius, amplitude if effect == "height" else HEIGHT):
        force = -gf.asm_generic(inside, 0, "w*contact*(Normalized(apart).[0;1])", 2, model)
        rows.append([effect, amplitude, radius, depth, f"{force:.7g}"])
    return rows


def main():
    import getfem as gf
    import numpy as np

    gf.util("trace level", 0)
    asked = sys.argv[1:] or list(CASES)
    rows = [row for row in csv.reader(open(TABLE)) if row[0] not in asked + ["effect"]] if TABLE.exists() else []
    for effect in asked:
        for amplitude in CASES[effect][0]:
            for radius in CASES[effect][1]:
                rows += curve(gf, np, radius, effect, amplitude)
                print(effect, amplitude, radius, "mm:", rows[-1][-1], "N at", rows[-1][3], "mm", flush=True)
        with open(TABLE, "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([["effect", "amplitude", "radius[mm]", "depth[mm]", "force[N]"]] + rows)


if __name__ == "__main__":
    main()
