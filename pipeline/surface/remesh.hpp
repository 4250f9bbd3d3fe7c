// Even triangles, and the question whether a surface crosses itself (CGAL polygon mesh processing).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <utility>
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

/// Triangles with edges near `edge_mm` on the same surface: splits, collapses, flips, tangential relaxation and projection
/// (Botsch & Kobbelt 2004). The surface must be closed, manifold and oriented. Regions become 0.
Surface remesh(const Surface& surface, double edge_mm, int iterations);

/// Pairs of triangles that cross or overlap, exact predicates, in a fixed order. The surface must be an oriented manifold.
std::vector<std::pair<int, int>> self_intersections(const Surface& surface);

}  // namespace palpate
