#!/usr/bin/env python3
# What Coulomb friction adds to the force of a ball on an incompressible layer, by GetFEM, axisymmetric: what the loop's solved_friction is fitted to.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The layer of curves.py, with shear multipliers: shear = clip(shear + r slip, mu pressure), slip per step (Alart and Curnier 1991).

    /usr/bin/python3 bench/hidden/friction.py RADIUS DEPTH MU ...

Prints depth, depth over radius and F(mu)/F(0) - 1 on the way in. Steps that do not converge end a row: deeper than 0.4 of the radius few do.
"""
import sys

import curves


def pressed(gf, np, radius, mu, depths):
    model, inside, mesh, u = curves.layer_model(gf, np, radius, "none", 0)
    shear = gf.MeshFem(mesh, 1)
    shear.set_classical_fem(2)
    model.add_filtered_fem_variable("shear", shear, 2)
    model.add_initialized_fem_data("before", u, np.zeros(u.nbdof()))
    model.add_initialized_data("moved", [0.0])
    model.add_initialized_data("friction", [mu])
    model.add_macro("along", "[Normalized(apart)(2);-Normalized(apart)(1)]")
    model.add_macro("trial", "shear+r*((u-before+[0;moved]).along)")
    model.add_macro("bound", "friction*pos_part(contact-r*gap)")
    clipped = "pos_part(trial+bound)-pos_part(trial-bound)-bound" if mu > 0 else "0"
    model.add_nonlinear_term(inside, f"w*(shear*(along.Test_u)+(shear-({clipped}))*Test_shear/r)" if mu > 0 else "w*shear*Test_shear", 2)
    forces, at = [], 0.0
    for depth in depths:
        model.set_variable("before", model.variable("u"))
        model.set_variable("depth", [depth])
        model.set_variable("moved", [depth - at])
        at = depth
        _, converged = model.solve("max_res", 1e-9, "max_iter", 80, "lsolver", "mumps", "lsearch", "simplest")
        if not converged:
            break
        forces.append(float(-gf.asm_generic(inside, 0, "w*(contact*Normalized(apart)-shear*along).[0;1]", 2, model)))
    return forces


def main():
    import getfem as gf
    import numpy as np

    gf.util("trace level", 0)
    radius, deepest, frictions = float(sys.argv[1]), float(sys.argv[2]), [float(mu) for mu in sys.argv[3:]]
    depths = [deepest * ((i + 1) / 12) ** 1.3 for i in range(12)]
    free = pressed(gf, np, radius, 0.0, depths)
    print("mu,depth[mm],depth_over_radius,added")
    for mu in frictions:
        for depth, force, without in zip(depths, pressed(gf, np, radius, mu, depths), free):
            print(f"{mu},{depth:.4f},{depth / radius:.4f},{force / without - 1:.5f}", flush=True)


if __name__ == "__main__":
    main()
