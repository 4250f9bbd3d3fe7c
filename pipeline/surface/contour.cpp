// Marching tetrahedra on the Kuhn subdivision.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/contour.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include <pipeline/surface/measure.hpp>

namespace palpate {
namespace {

/// Corners of a cube are numbered by bits: 1 along i, 2 along j, 4 along k. All six are positively oriented paths 0 → 7.
constexpr int kuhn[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

class Marcher {
 public:
  Marcher(const Scan& field, double level)
      : field_(field), level_(level), mirrored_(field.grid.lps_from_voxel.determinant() < 0) {
    for (int c = 0; c < 8; ++c) offset_[c] = field.grid.at(c & 1, c >> 1 & 1, c >> 2);
  }

  Surface run() {
    const auto& size = field_.grid.size;
    for (int k = 0; k + 1 < size[2]; ++k)
      for (int j = 0; j + 1 < size[1]; ++j)
        for (int i = 0; i + 1 < size[0]; ++i) cube(field_.grid.at(i, j, k));
    surface_.triangle_region.assign(surface_.triangles.size(), 0);
    return std::move(surface_);
  }

 private:
  bool inside(std::size_t node) const { return field_.voxels[node] > level_; }

  void cube(std::size_t node) {
    int count = 0;
    for (int c = 0; c < 8; ++c) count += inside(node + offset_[c]);
    if (count == 0 || count == 8) return;
    for (const auto& tet : kuhn) cut(node, tet);
  }

  /// Corners sorted inside first; the sign of that permutation turns the triangle outward.
  void cut(std::size_t node, const int (&tet)[4]) {
    std::array<int, 4> order{};
    int in = 0, out = 4;
    for (int v = 0; v < 4; ++v)
      if (inside(node + offset_[tet[v]])) order[in++] = v;
    for (int v = 3; v >= 0; --v)
      if (!inside(node + offset_[tet[v]])) order[--out] = v;
    if (in == 0 || in == 4) return;
    int inversions = 0;
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) inversions += order[a] > order[b];
    const bool flip = (inversions % 2 == 1) != mirrored_;
    const auto on = [&](int a, int b) { return vertex(node, tet[order[a]], tet[order[b]]); };
    if (in == 1) {
      triangle(on(0, 1), on(0, 2), on(0, 3), flip);
    } else if (in == 3) {
      triangle(on(3, 0), on(3, 1), on(3, 2), flip);
    } else {
      const int ac = on(0, 2), ad = on(0, 3), bd = on(1, 3), bc = on(1, 2);
      triangle(ac, ad, bd, flip);
      triangle(ac, bd, bc, flip);
    }
  }

  void triangle(int a, int b, int c, bool flip) {
    surface_.triangles.push_back(flip ? std::array<int, 3>{a, c, b} : std::array<int, 3>{a, b, c});
  }

  /// One point per cut edge; an edge is its lower node and one of seven directions. Kept off the ends, so that no triangle is a
  /// point.
  int vertex(std::size_t node, int a, int b) {
    const int low = std::min(a, b), high = std::max(a, b);
    const std::uint64_t key = std::uint64_t(node + offset_[low]) * 8 + (high - low);
    const auto [entry, fresh] = index_.try_emplace(key, int(surface_.points.size()));
    if (fresh) {
      const double fa = field_.voxels[node + offset_[low]], fb = field_.voxels[node + offset_[high]];
      const double t = std::clamp((level_ - fa) / (fb - fa), 0.02, 0.98);
      surface_.points.push_back(
          field_.grid.lps_from_voxel((1 - t) * place(node + offset_[low]) + t * place(node + offset_[high])));
    }
    return entry->second;
  }

  Vec3 place(std::size_t node) const {
    const auto& size = field_.grid.size;
    return {double(node % size[0]), double(node / size[0] % size[1]), double(node / size[0] / size[1])};
  }

  const Scan& field_;
  double level_;
  bool mirrored_;
  std::array<std::size_t, 8> offset_{};
  std::unordered_map<std::uint64_t, int> index_;  // only looked up, never walked
  Surface surface_;
};

}  // namespace

Surface contour(const Scan& field, double level) { return Marcher(field, level).run(); }

Surface contour_of_volume(const Scan& field, double mm3) {
  double level = 0, slope = 0;
  Surface surface = contour(field, level);
  for (int step = 0; step < 8; ++step) {
    const double excess = volume_mm3(surface) - mm3;
    if (std::abs(excess) <= 1e-4 * mm3) break;
    // dV/dlevel = −A / |∇f|; the first slope comes from a small step down the field
    if (slope == 0) slope = (volume_mm3(contour(field, level + 0.05)) - volume_mm3(surface)) / 0.05;
    if (!(slope < 0)) break;
    const double next = std::clamp(level + std::clamp(-excess / slope, -0.5, 0.5), -1.5, 1.5);
    Surface moved = contour(field, next);
    if (next != level) slope = (volume_mm3(moved) - volume_mm3(surface)) / (next - level);
    surface = std::move(moved);
    level = next;
  }
  return surface;
}

}  // namespace palpate
