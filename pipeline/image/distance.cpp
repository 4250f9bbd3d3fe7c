// Lower envelope of parabolas, axis by axis: D(p) = min_q h² (p − q)² + f(q) (Felzenszwalb & Huttenlocher 2012, algorithm 1).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/distance.hpp>

#include <limits>

namespace palpate {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Workspace of one line, in the paper's letters: parabola k has its vertex at v[k] and is lowest from z[k] to z[k + 1].
struct Line {
  explicit Line(int n) : f(n), v(n), z(n + 1) {}
  std::vector<double> f;
  std::vector<int> v;
  std::vector<double> z;

  /// Replaces f by its transform for samples h apart. Infinite samples carry no parabola.
  void transform(double h, std::vector<double>& d) {
    const int n = static_cast<int>(f.size());
    const double h2 = h * h;
    int k = -1;
    for (int q = 0; q < n; ++q) {
      if (f[q] == infinity) continue;
      double s = -infinity;
      for (; k >= 0; --k) {
        s = ((f[q] + h2 * q * q) - (f[v[k]] + h2 * v[k] * v[k])) / (2 * h2 * (q - v[k]));  // where parabola q crosses v[k]
        if (s > z[k]) break;
        s = -infinity;
      }
      v[++k] = q;
      z[k] = s;
      z[k + 1] = infinity;
    }
    if (k < 0) {
      d.assign(n, infinity);
      return;
    }
    k = 0;
    for (int q = 0; q < n; ++q) {
      while (z[k + 1] < q) ++k;
      d[q] = h2 * (q - v[k]) * (q - v[k]) + f[v[k]];
    }
  }
};

void transform_axis(std::vector<float>& d2, const Grid& grid, int axis, double h) {
  const std::size_t stride = axis == 0 ? 1 : axis == 1 ? grid.size[0] : std::size_t(grid.size[0]) * grid.size[1];
  const int n = grid.size[axis];
  const int u = axis == 0 ? 1 : 0, w = axis == 2 ? 1 : 2;
  Line line(n);
  std::vector<double> out(n);
  for (int b = 0; b < grid.size[w]; ++b)
    for (int a = 0; a < grid.size[u]; ++a) {
      VoxelIndex start{0, 0, 0};
      start[u] = a;
      start[w] = b;
      float* first = d2.data() + grid.at(start[0], start[1], start[2]);
      for (int q = 0; q < n; ++q) line.f[q] = first[q * stride];
      line.transform(h, out);
      for (int q = 0; q < n; ++q) first[q * stride] = static_cast<float>(out[q]);
    }
}

}  // namespace

std::vector<float> squared_distance_mm2(const Mask& mask) {
  std::vector<float> d2(mask.voxels.size());
  for (std::size_t p = 0; p < d2.size(); ++p) d2[p] = mask.voxels[p] ? 0.0f : std::numeric_limits<float>::infinity();
  const Vec3 h = mask.grid.spacing();
  for (int axis = 0; axis < 3; ++axis) transform_axis(d2, mask.grid, axis, h[axis]);
  return d2;
}

}  // namespace palpate
