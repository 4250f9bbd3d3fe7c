// Better triangles on the same surface: edges flipped to the Delaunay side, points drawn to where their worst triangle is best.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/nearest_point.hpp>

namespace palpate {

/// Rounds of flips and of moves of the points off the rims, which stay on `surface`; a move is kept when the largest equiangular
/// skew around the point becomes smaller, a flip when that of its two triangles does. (Freitag & Ollivier-Gooch 1997, for tetrahedra.)
void improve_shell(ShellMesh& mesh, const SurfaceIndex& surface, int rounds);

}  // namespace palpate
