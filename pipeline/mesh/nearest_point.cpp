// Cells are searched in growing cubes around x until no unseen cell can hold anything nearer.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/nearest_point.hpp>

#include <algorithm>
#include <limits>

namespace palpate {

Vec3 nearest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bx = x - b;
  const double d3 = dot(ab, bx), d4 = dot(ac, bx);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  const Vec3 cx = x - c;
  const double d5 = dot(ab, cx), d6 = dot(ac, cx);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  const double scale = 1 / (va + vb + vc);
  return a + (vb * scale) * ab + (vc * scale) * ac;
}

SurfaceIndex::SurfaceIndex(Surface surface) : surface_(std::move(surface)) {
  Vec3 high = low_ = surface_.points.front();
  for (const Vec3& p : surface_.points)
    for (int a = 0; a < 3; ++a) {
      low_[a] = std::min(low_[a], p[a]);
      high[a] = std::max(high[a], p[a]);
    }
  const double longest = std::max({high[0] - low_[0], high[1] - low_[1], high[2] - low_[2], 1e-9});
  cell_mm_ = longest / std::clamp(std::sqrt(surface_.triangles.size() / 4.0), 1.0, 150.0);
  for (int a = 0; a < 3; ++a) size_[a] = 1 + static_cast<int>((high[a] - low_[a]) / cell_mm_);
  std::vector<std::pair<int, int>> pairs;  // cell, triangle
  for (int t = 0; t < surface_.triangles.size(); ++t) {
    std::array<int, 3> first{1 << 30, 1 << 30, 1 << 30}, last{0, 0, 0};
    for (int i : surface_.triangles[t])
      for (int a = 0; a < 3; ++a) {
        first[a] = std::min(first[a], cell_of(surface_.points[i])[a]);
        last[a] = std::max(last[a], cell_of(surface_.points[i])[a]);
      }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) pairs.push_back({number({i, j, k}), t});
  }
  std::sort(pairs.begin(), pairs.end());
  start_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2] + 1, 0);
  for (const auto& [cell, triangle] : pairs) {
    ++start_[cell + 1];
    members_.push_back(triangle);
  }
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
}

std::array<int, 3> SurfaceIndex::cell_of(const Vec3& x) const {
  std::array<int, 3> cell;
  for (int a = 0; a < 3; ++a) cell[a] = static_cast<int>(std::clamp(std::floor((x[a] - low_[a]) / cell_mm_), 0.0, size_[a] - 1.0));
  return cell;
}

void SurfaceIndex::look_into(int cell, const Vec3& x, NearestPoint& best) const {
  for (int m = start_[cell]; m < start_[cell + 1]; ++m) {
    const auto& [i, j, k] = surface_.triangles[members_[m]];
    const Vec3 point = nearest_on_triangle(x, surface_.points[i], surface_.points[j], surface_.points[k]);
    const double distance = norm(x - point);
    if (distance < best.distance || (distance == best.distance && members_[m] < best.triangle)) best = {point, members_[m], distance};
  }
}

NearestPoint SurfaceIndex::nearest(const Vec3& x) const {
  const auto home = cell_of(x);
  NearestPoint best{{}, -1, std::numeric_limits<double>::infinity()};
  const int reach = std::max({size_[0], size_[1], size_[2]});
  for (int ring = 0; ring <= reach; ++ring) {
    // Cells of this ring are at least ring - 1 cells away from x; true for an x outside the grid too, whose home is its nearest cell.
    if (best.distance < (ring - 1) * cell_mm_) break;
    for (int k = std::max(0, home[2] - ring); k <= std::min(size_[2] - 1, home[2] + ring); ++k)
      for (int j = std::max(0, home[1] - ring); j <= std::min(size_[1] - 1, home[1] + ring); ++j) {
        const bool face = std::abs(k - home[2]) == ring || std::abs(j - home[1]) == ring;
        for (int i = home[0] - ring; i <= home[0] + ring; i += face || ring == 0 ? 1 : 2 * ring)
          if (i >= 0 && i < size_[0]) look_into(number({i, j, k}), x, best);
      }
  }
  return best;
}

}  // namespace palpate
