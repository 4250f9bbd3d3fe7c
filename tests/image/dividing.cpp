// Parts of an organ told apart by intensity: two balls on a bar, with blurred rims and noise.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <palpate/errors.hpp>
#include <pipeline/image/dividing.hpp>
#include <pipeline/image/smoothing.hpp>

namespace palpate {
namespace {

constexpr float bar = 700, left = 1000, right = 1300, fat = 250;

/// 0 outside, 1 the bar, 2 and 3 the balls at its ends.
int truth(double x, double y, double z) {
  if (std::hypot(x - 12, y - 12, z - 12) <= 8) return 2;
  if (std::hypot(x - 47, y - 12, z - 12) <= 8) return 3;
  return x >= 12 && x <= 47 && std::hypot(y - 12, z - 12) <= 4 ? 1 : 0;
}

struct Example {
  Scan scan;
  Mask mask;
};

Example example() {
  Grid grid;
  grid.size = {60, 24, 24};
  Example e{{grid, {}}, {grid, {}}};
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0, 40);
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 60; ++i) {
        const int part = truth(i, j, k);
        constexpr float levels[] = {fat, bar, left, right};
        e.scan.voxels.push_back(levels[part] + noise(random));
        e.mask.voxels.push_back(part > 0);
      }
  e.scan = smoothing::by_name("gaussian").apply(e.scan, {0.7, {}});
  return e;
}

const std::vector<VoxelIndex> seeds = {{30, 12, 12}, {12, 12, 12}, {47, 12, 12}};

TEST(Dividing, finds_bar_and_balls_though_rims_look_like_others) {
  const Example e = example();
  const Labels labels = divided(e.scan, e.mask, seeds, 3);
  std::size_t wrong = 0, inside = 0;
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 60; ++i) {
        inside += truth(i, j, k) > 0;
        wrong += labels(i, j, k) != truth(i, j, k);
        EXPECT_EQ(labels(i, j, k) > 0, e.mask(i, j, k) > 0);
      }
  EXPECT_LE(wrong, 0.02 * inside);  // where bar and balls meet, a voxel of blur
}

TEST(Dividing, numbers_follow_the_seeds) {
  const Example e = example();
  const Labels labels = divided(e.scan, e.mask, {seeds[2], seeds[0], seeds[1]}, 3);
  EXPECT_EQ(labels(47, 12, 12), 1);
  EXPECT_EQ(labels(30, 12, 12), 2);
  EXPECT_EQ(labels(12, 12, 12), 3);
}

TEST(Dividing, voxels_no_part_reaches_stay_out) {
  Example e = example();
  e.mask(1, 1, 22) = 1;
  EXPECT_EQ(divided(e.scan, e.mask, seeds, 3)(1, 1, 22), 0);
}

TEST(Dividing, refuses_a_seed_at_the_rim) {
  const Example e = example();
  EXPECT_THROW(divided(e.scan, e.mask, {{30, 15, 12}, seeds[1]}, 3), Failure);
}

}  // namespace
}  // namespace palpate
