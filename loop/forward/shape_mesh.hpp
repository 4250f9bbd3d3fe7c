// Meshes of simple shapes for one tool at one place: bricks graded towards the contact, six tetrahedra each.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/mesh_files.hpp>
#include <loop/set/set.hpp>

namespace palpate::loop {

/// A block or cylinder standing on z = 0 around the axis z; edges of `fine_mm` under the place, growing by 1.4 a row away from it.
/// Faces are in the regions "base" (z = 0) and "outside". With `wide_mm` the sides are moved out until the place is so far from them; the mesh in
/// between them as they are stays as it is.
TetMesh shape_mesh(const Specimen& specimen, const Vec3& place_mm, double fine_mm, double wide_mm = 0);

}  // namespace palpate::loop
