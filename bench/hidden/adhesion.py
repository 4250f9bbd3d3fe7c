#!/usr/bin/env python3
# Contact radius under a ball on the plain layer of curves.py, by GetFEM: what adhesion in make.py's sets rests on. Rewrites contact_radii.csv beside this file.
# SPDX-License-Identifier: GPL-3.0-or-later
"""    /usr/bin/python3 bench/hidden/adhesion.py

The square of the contact pressure is nearly a line over the square of the radius, as in Hertz' contact: where that line, from 0.4 to 0.95 of the radius, meets zero is the edge, in the deformed place. Cells of a tenth and of a
twentieth of the ball's radius are compared in the output; contacts less than four of these wide, known to 3 % only, are left out.
"""
import csv
import pathlib

import curves


def contact_radius(np, model, mesh, estimate):
    """In the deformed place, mm."""
    edge = estimate
    for _ in range(20):
        at = np.array([np.linspace(0.4, 0.95, 60) * edge, np.full(60, curves.HEIGHT)])
        pressure = model.interpolation("contact", at, mesh)
        slope, start = np.polyfit(at[0] ** 2, pressure**2, 1)
        edge = np.sqrt(-start / slope)
    moved = model.interpolation("u(1)", np.array([[edge], [curves.HEIGHT]]), mesh)
    return float(edge + moved[0])


def radii(gf, np, radius, fine):
    model, _, mesh, _ = curves.layer_model(gf, np, radius, "none", 0, fine)
    rows = []
    for depth in curves.pressed(model, radius, curves.HEIGHT):
        rows.append([radius, depth, round(contact_radius(np, model, mesh, 0.95 * (radius * depth) ** 0.5), 5)])
    return rows


def main():
    import getfem as gf
    import numpy as np

    gf.util("trace level", 0)
    rows = []
    for radius in (5.0, 2.5):
        coarse, fine = radii(gf, np, radius, 10), radii(gf, np, radius, 20)
        for (_, depth, a), (_, _, b) in zip(coarse, fine):
            print(f"ball of {radius} mm, {depth} mm deep: {a:.4f}, {b:.4f} mm, over the root of R d {b / (radius * depth) ** 0.5:.4f}", flush=True)
        rows += [row for row in fine if row[2] > 4 * radius / 20]
    with open(pathlib.Path(__file__).with_name("contact_radii.csv"), "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([["radius[mm]", "depth[mm]", "contact_radius[mm]"]] + rows)


if __name__ == "__main__":
    main()
