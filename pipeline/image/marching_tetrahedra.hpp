// The zero level of an implicit shape as a closed triangle surface, every vertex on it to 1e-9 mm.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <pipeline/image/implicit_shapes.hpp>

namespace palpate {

struct TriangleSoup {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Contours f = 0 on a lattice of `edge_mm` over the box (and a little more); vertices are then moved onto f = 0 by Newton's method.
/// Lattice cells are split into six tetrahedra (Kuhn 1960), so the result is closed and manifold by construction.
TriangleSoup contour(const Implicit& f, const Box& box, double edge_mm, int threads);

double area_mm2(const TriangleSoup& s);
/// ⅙ Σ a · (b × c): positive when the triangles face outwards.
double enclosed_mm3(const TriangleSoup& s);

}  // namespace palpate
