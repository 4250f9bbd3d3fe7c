// The nearest point of a triangle to a block, against the nearest of many points of the triangle.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include <solver/explicit/block_triangle.hpp>

namespace palpate::explicit_shell {
namespace {

double to_block(const Lanes& x, const Lanes& half) {
  Lanes from = x;
  for (int c = 0; c < 3; ++c) from[c] = std::clamp(x[c], -half[c], half[c]);
  return length3(x - from);
}

double by_points(const std::array<Lanes, 3>& x, const Lanes& half, int cuts) {
  double least = 1e30;
  for (int i = 0; i <= cuts; ++i)
    for (int j = 0; j <= cuts - i; ++j) {
      const double u = double(i) / cuts, v = double(j) / cuts;
      least = std::min(least, to_block((1 - u - v) * x[0] + u * x[1] + v * x[2], half));
    }
  return least;
}

TEST(BlockTriangle, NoPointOfManyIsNearer) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> place(-6, 6), size(-2, 2);
  const Lanes half{4, 1, 2, 0};
  constexpr int cuts = 60;
  int between = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Lanes middle{place(engine), place(engine), place(engine), 0};
    std::array<Lanes, 3> x;
    for (Lanes& p : x) p = middle + Lanes{size(engine), size(engine), size(engine), 0};
    const double wanted = by_points(x, half, cuts);
    if (wanted < 0.2) continue;  // may touch
    const auto near = nearest_to_block(x, half, 20);
    const double edge = 7.0 / cuts;
    EXPECT_LE(near.distance, wanted + 1e-12);
    EXPECT_GE(near.distance, wanted - edge);
    const Lanes at = near.weights[0] * x[0] + near.weights[1] * x[1] + near.weights[2] * x[2];
    EXPECT_NEAR(near.weights[0] + near.weights[1] + near.weights[2], 1, 1e-12);
    EXPECT_GE(std::min({near.weights[0], near.weights[1], near.weights[2]}), -1e-12);
    EXPECT_NEAR(to_block(at, half), near.distance, 1e-9);
    EXPECT_NEAR(length3(near.apart), near.distance, 1e-12);
    between += std::max({near.weights[0], near.weights[1], near.weights[2]}) < 1;
    if (near.distance < 1) EXPECT_NEAR(nearest_to_block(x, half, 1).distance, near.distance, 1e-12);
    else EXPECT_EQ(nearest_to_block(x, half, 1).distance, 1);
  }
  EXPECT_GE(between, 300);  // not corners alone
}

}  // namespace
}  // namespace palpate::explicit_shell
