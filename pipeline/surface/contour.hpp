// The level set of a field as triangles, by marching tetrahedra: closed and manifold by construction.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/mesh_files.hpp>
#include <palpate/volume.hpp>

namespace palpate {

/// The surface f = level, f > level inside, triangles counter-clockwise from outside whatever the handedness of the lattice.
/// Every cube is cut into six tetrahedra around its diagonal 0–7 (Kuhn 1960), the same way in all cubes, so that faces match.
/// Regions are 0. The field must be below the level on its border.
Surface contour(const Scan& field, double level);

/// The level whose contour encloses `mm3`, by at most eight secant steps to 1e-4 relative, and that contour.
Surface contour_of_volume(const Scan& field, double mm3);

}  // namespace palpate
