// How far one surface lies from another.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

struct Distance {
  double mean_mm = 0;     ///< over the area of the first surface, sampled at the centroids of its triangles
  double largest_mm = 0;  ///< over the same places
  Vec3 largest_at{0, 0, 0};
};

/// From the triangles of `from` to the nearest points of `to`. Both must have triangles.
Distance distance(const Surface& from, const Surface& to);

/// For each triangle of `from` the triangle of `to` nearest to its centroid.
std::vector<int> nearest_triangles(const Surface& from, const Surface& to);

}  // namespace palpate
