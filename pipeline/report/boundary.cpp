// Faces sorted by their point numbers: the two sides of an inner face become neighbours.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/boundary.hpp>

#include <algorithm>

namespace palpate {
namespace {

/// The faces of a tetrahedron of positive volume, outward.
constexpr int outward[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

struct Side {
  std::array<int, 3> key;
  BoundaryFace face;
};

}  // namespace

std::vector<BoundaryFace> boundary_faces(const std::vector<std::array<int, 4>>& tets, const std::vector<bool>& chosen) {
  std::vector<Side> sides;
  sides.reserve(4 * tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (const auto& corners : outward) {
      const std::array<int, 3> points{tets[t][corners[0]], tets[t][corners[1]], tets[t][corners[2]]};
      std::array<int, 3> key = points;
      std::sort(key.begin(), key.end());
      sides.push_back({key, {points, static_cast<int>(t), false}});
    }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key < b.key; });
  std::vector<BoundaryFace> faces;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool paired = i + 1 < sides.size() && sides[i + 1].key == sides[i].key;
    const bool first = chosen[sides[i].face.tet], second = paired && chosen[sides[i + 1].face.tet];
    if (first != second) {
      faces.push_back(first ? sides[i].face : sides[i + 1].face);
      faces.back().inner = paired;
    }
    if (paired) ++i;
  }
  return faces;
}

}  // namespace palpate
