// Faces that only one of the chosen tetrahedra has: the skin of a mesh, or of a part of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

namespace palpate {

struct BoundaryFace {
  std::array<int, 3> points;  ///< counter-clockwise seen from outside
  int tet;                    ///< whose face it is
  bool inner;                 ///< a tetrahedron that was not chosen lies behind it
};

/// `chosen`: one flag per tetrahedron. The order of faces follows their sorted point numbers.
std::vector<BoundaryFace> boundary_faces(const std::vector<std::array<int, 4>>& tets, const std::vector<bool>& chosen);

}  // namespace palpate
