// Remesh, relax what is poor, remesh.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/even_triangles.hpp>

#include <pipeline/surface/measure.hpp>
#include <pipeline/surface/remesh.hpp>
#include <pipeline/surface/smooth.hpp>

namespace palpate {

Surface even_triangles(const Surface& surface, double edge_mm, int iterations) {
  Surface best = remesh(surface, edge_mm, iterations);
  auto poor = poor_triangles(best, 20, 40);
  for (int round = 0; round < 5 && !poor.empty(); ++round) {
    Surface relaxed = best;
    relax_around(relaxed, poor, 2, 5);
    relaxed = remesh(relaxed, edge_mm, 3);
    const auto still_poor = poor_triangles(relaxed, 20, 40);
    if (still_poor.size() >= poor.size() || !self_intersections(relaxed).empty()) break;
    best = std::move(relaxed);
    poor = still_poor;
  }
  return best;
}

}  // namespace palpate
