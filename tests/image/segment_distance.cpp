// Distance transform, opening and closing against brute force on small anisotropic lattices.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include <pipeline/image/distance.hpp>
#include <pipeline/image/morphology.hpp>

namespace palpate {
namespace {

Mask random_mask(std::array<int, 3> size, const Vec3& spacing, double density, unsigned seed) {
  Grid grid;
  grid.size = size;
  for (int a = 0; a < 3; ++a) grid.lps_from_voxel.columns[a][a] = spacing[a];
  Mask mask{grid, std::vector<std::uint8_t>(grid.count())};
  std::mt19937 random(seed);
  for (auto& v : mask.voxels) v = random() < density * 4294967295.0;
  return mask;
}

/// `visit(i, j, k)` over a block, ends included.
template <class Visit>
void for_each(VoxelIndex first, VoxelIndex last, Visit&& visit) {
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) visit(i, j, k);
}

VoxelIndex last_of(const Mask& m) { return {m.grid.size[0] - 1, m.grid.size[1] - 1, m.grid.size[2] - 1}; }

/// The mask in a lattice with `margin` more voxels on every side.
Mask padded(const Mask& mask, int margin) {
  Mask out = mask;
  for (int& n : out.grid.size) n += 2 * margin;
  out.voxels.assign(out.grid.count(), 0);
  for_each({0, 0, 0}, last_of(mask), [&](int i, int j, int k) { out(i + margin, j + margin, k + margin) = mask(i, j, k); });
  return out;
}

Mask unpadded(const Mask& mask, int margin) {
  Mask out = mask;
  for (int& n : out.grid.size) n -= 2 * margin;
  out.voxels.assign(out.grid.count(), 0);
  for_each({0, 0, 0}, last_of(out), [&](int i, int j, int k) { out(i, j, k) = mask(i + margin, j + margin, k + margin); });
  return out;
}

/// Some (of any) or every (of all) voxel of the ball around each voxel; beyond the lattice is outside.
enum class Quantifier { some, every };
Mask brute(const Mask& mask, double radius, Quantifier quantifier) {
  const Vec3 h = mask.grid.spacing();
  Mask out = mask;
  for_each({0, 0, 0}, last_of(mask), [&](int i, int j, int k) {
    bool some = false, every = true;
    const int reach = 6;
    for_each({-reach, -reach, -reach}, {reach, reach, reach}, [&](int a, int b, int c) {
      if (a * a * h[0] * h[0] + b * b * h[1] * h[1] + c * c * h[2] * h[2] > radius * radius * (1 + 1e-5)) return;
      const int x = i + a, y = j + b, z = k + c;
      const bool in_lattice =
          x >= 0 && y >= 0 && z >= 0 && x < mask.grid.size[0] && y < mask.grid.size[1] && z < mask.grid.size[2];
      const bool inside = in_lattice && mask(x, y, z);
      some = some || inside;
      every = every && inside;
    });
    out(i, j, k) = quantifier == Quantifier::some ? some : every;
  });
  return out;
}

TEST(Distance, equals_brute_force) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Mask mask = random_mask({9, 7, 6}, {0.7, 1.3, 2.5}, 0.03, seed);
    const auto d2 = squared_distance_mm2(mask);
    const Vec3 h = mask.grid.spacing();
    for_each({0, 0, 0}, last_of(mask), [&](int i, int j, int k) {
      double best = std::numeric_limits<double>::infinity();
      for_each({0, 0, 0}, last_of(mask), [&](int x, int y, int z) {
        if (mask(x, y, z))
          best = std::min(best, std::pow(h[0] * (x - i), 2) + std::pow(h[1] * (y - j), 2) + std::pow(h[2] * (z - k), 2));
      });
      EXPECT_FLOAT_EQ(d2[mask.grid.at(i, j, k)], best) << i << " " << j << " " << k;  // float round-off
    });
  }
}

TEST(Distance, of_nothing_is_infinite) {
  for (float d2 : squared_distance_mm2(random_mask({3, 4, 5}, {1, 1, 1}, 0, 1))) EXPECT_TRUE(std::isinf(d2));
}

TEST(Morphology, equals_brute_force) {
  constexpr int margin = 5;
  const Vec3 spacing{0.7, 1.0, 1.6};
  for (unsigned seed = 1; seed <= 3; ++seed)
    for (double radius : {0.6, 1.0, 2.0}) {
      const Mask dense = random_mask({10, 8, 7}, spacing, 0.9, seed), sparse = random_mask({10, 8, 7}, spacing, 0.2, seed);
      const Mask wide_dense = padded(dense, margin), wide_sparse = padded(sparse, margin);
      EXPECT_EQ(dilated(sparse, radius).voxels, unpadded(brute(wide_sparse, radius, Quantifier::some), margin).voxels);
      EXPECT_EQ(eroded(dense, radius).voxels, unpadded(brute(wide_dense, radius, Quantifier::every), margin).voxels);
      const Mask opening = brute(brute(wide_dense, radius, Quantifier::every), radius, Quantifier::some);
      EXPECT_EQ(opened(dense, radius).voxels, unpadded(opening, margin).voxels);
      const Mask closing = brute(brute(wide_sparse, radius, Quantifier::some), radius, Quantifier::every);
      EXPECT_EQ(closed(sparse, radius).voxels, unpadded(closing, margin).voxels);
    }
}

TEST(Morphology, opening_only_removes_and_closing_only_adds) {
  const Mask mask = random_mask({14, 12, 9}, {0.5, 0.5, 2}, 0.6, 7);
  const Mask less = opened(mask, 1), more = closed(mask, 1);
  for (std::size_t p = 0; p < mask.voxels.size(); ++p) {
    EXPECT_LE(less.voxels[p], mask.voxels[p]);
    EXPECT_GE(more.voxels[p], mask.voxels[p]);
  }
  EXPECT_EQ(opened(less, 1).voxels, less.voxels);
  EXPECT_EQ(closed(more, 1).voxels, more.voxels);
}

TEST(Morphology, of_nothing_is_nothing) {
  const Mask empty = random_mask({4, 4, 4}, {1, 1, 1}, 0, 1);
  EXPECT_EQ(count_inside(opened(empty, 2)), 0);
  EXPECT_EQ(count_inside(closed(empty, 2)), 0);
}

}  // namespace
}  // namespace palpate
