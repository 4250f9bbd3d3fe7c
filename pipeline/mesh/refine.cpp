// An edge is split when it is the longest of all tetrahedra around it; on the way there, longer ones first.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/refine.hpp>

#include <algorithm>
#include <tuple>

namespace palpate {
namespace {

using Edge = std::array<int, 2>;

/// By length now and at rest together (a length in six dimensions, so that bisection makes it shorter), ties by nodes.
struct Longest {
  double size2 = -1;
  Edge edge{0, 0};
  bool operator<(const Longest& other) const { return std::tie(size2, edge) < std::tie(other.size2, other.edge); }
};

Longest longest_of(const CarriedMesh& mesh, int tet) {
  Longest longest;
  const auto& corners = mesh.tet(tet);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) {
      const Edge edge = {std::min(corners[i], corners[j]), std::max(corners[i], corners[j])};
      longest = std::max(longest, Longest{mesh.size2(edge[0], edge[1]), edge});
    }
  return longest;
}

/// Rivara's path from a tetrahedron to an edge that is the longest of all tetrahedra around it.
Edge terminal_edge(const CarriedMesh& mesh, int tet) {
  Longest longest = longest_of(mesh, tet);
  for (;;) {
    Longest next = longest;
    for (int other : mesh.around(longest.edge[0], longest.edge[1])) next = std::max(next, longest_of(mesh, other));
    if (!(longest < next)) return longest.edge;
    longest = next;
  }
}

double longest_now(const CarriedMesh& mesh, int tet) {
  double longest = 0;
  const auto& corners = mesh.tet(tet);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) longest = std::max(longest, norm(mesh.points()[corners[i]] - mesh.points()[corners[j]]));
  return longest;
}

}  // namespace

void refine(CarriedMesh& mesh, const std::vector<double>& target_mm) {
  for (int t = 0; t < static_cast<int>(mesh.tets()); ++t) {  // those that come on the way are visited too
    const double target = target_mm[mesh.parent(t)];
    if (!(target > 0)) continue;
    while (mesh.alive(t) && longest_now(mesh, t) > target) {
      const Edge edge = terminal_edge(mesh, t);
      mesh.split(edge[0], edge[1]);
    }
  }
}

}  // namespace palpate
