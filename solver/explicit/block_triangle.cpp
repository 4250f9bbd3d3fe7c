// Corners first, then the block's corners, then edge against edge, each only where boxes around them come within reach.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/block_triangle.hpp>

#include <algorithm>
#include <cmath>

namespace palpate::explicit_shell {

std::array<double, 3> nearest(const Lanes& p, const Lanes& a, const Lanes& b, const Lanes& c) {
  const Lanes ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot3(ab, ap), d2 = dot3(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Lanes bp = p - b;
  const double d3 = dot3(ab, bp), d4 = dot3(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Lanes cp = p - c;
  const double d5 = dot3(ab, cp), d6 = dot3(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

namespace {

struct Search {
  const std::array<Lanes, 3>& x;
  NearBlock best;

  void consider(const std::array<double, 3>& weights, const Lanes& from) {
    const Lanes apart = weights[0] * x[0] + weights[1] * x[1] + weights[2] * x[2] - from;
    const double distance = length3(apart);
    if (distance < best.distance) best = {weights, apart, distance};
  }

  /// Where the triangle's edge k → l passes the block's edge through `middle` along `axis`, `half` to both sides.
  void pass(int k, int l, const Lanes& middle, int axis, double half) {
    const Lanes d = x[l] - x[k], r = x[k] - middle;
    const double a = dot3(d, d), along = d[axis], f = r[axis], c = dot3(d, r), both = a - along * along;
    double s = both > 1e-12 * a ? std::clamp((along * f - c) / both, 0.0, 1.0) : 0.5;
    const double t = std::clamp(f + s * along, -half, half);
    s = std::clamp((t * along - c) / a, 0.0, 1.0);
    Lanes from = middle;
    from[axis] += std::clamp(f + s * along, -half, half);
    std::array<double, 3> weights{0, 0, 0};
    weights[k] = 1 - s, weights[l] = s;
    consider(weights, from);
  }
};

}  // namespace

NearBlock nearest_to_block(const std::array<Lanes, 3>& x, const Lanes& half, double within) {
  Search search{x, {{1, 0, 0}, Lanes{}, within}};
  Lanes low = x[0], high = x[0];
  for (int k = 0; k < 3; ++k) {
    Lanes from = x[k];
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], x[k][c]), high[c] = std::max(high[c], x[k][c]);
      from[c] = std::clamp(x[k][c], -half[c], half[c]);
    }
    std::array<double, 3> weights{0, 0, 0};
    weights[k] = 1;
    search.consider(weights, from);
  }
  const auto reaches = [&](int c, double from, double to) { return low[c] - within < to && high[c] + within > from; };
  for (int side = 0; side < 8; ++side) {
    const Lanes corner{side & 1 ? half[0] : -half[0], side & 2 ? half[1] : -half[1], side & 4 ? half[2] : -half[2], 0};
    if (reaches(0, corner[0], corner[0]) && reaches(1, corner[1], corner[1]) && reaches(2, corner[2], corner[2]))
      search.consider(nearest(corner, x[0], x[1], x[2]), corner);
    for (int axis = 0; axis < 3; ++axis) {  // the edge from this corner, where the corner is the lower one
      if (side & (1 << axis)) continue;
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      if (!reaches(axis, -half[axis], half[axis]) || !reaches(b, corner[b], corner[b]) || !reaches(c, corner[c], corner[c])) continue;
      Lanes middle = corner;
      middle[axis] = 0;
      for (int k = 0; k < 3; ++k) search.pass(k, (k + 1) % 3, middle, axis, half[axis]);
    }
  }
  return search.best;
}

}  // namespace palpate::explicit_shell
