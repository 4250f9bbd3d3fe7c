// The row's length is found again from a motion that a row with this length made.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <loop/forward/memory_length.hpp>
#include <loop/forward/row.hpp>

namespace palpate::loop {
namespace {

constexpr double deepest = 4;

SolvedCurve elastic() {
  SolvedCurve curve;
  for (int i = 1; i <= 40; ++i) {
    curve.depth_mm.push_back(0.1 * i);
    curve.force_N.push_back(0.05 * std::pow(0.1 * i, 1.5));
  }
  return curve;
}

SolvedMotion motion(double length) {
  std::vector<double> depths, forces;
  for (int i = 0; i <= 400; ++i) {
    depths.push_back(0.0101 * i);
    forces.push_back(0.05 * std::pow(depths.back(), 1.5));
  }
  Tissue tissue;
  tissue.prony = {{0.2, 4}};
  Row row(springs_of(depths, forces), tissue, deepest, true, length);
  SolvedMotion made{{0}, {0}, {0}};
  for (int k = 1; k <= 180; ++k) {
    const double t = 0.1 * k;
    made.t_s.push_back(t);
    made.depth_mm.push_back(t < 4 ? t : t < 14 ? deepest : 18 - t);
    made.force_N.push_back(row.advance(made.depth_mm.back(), 0.1));
  }
  return made;
}

TEST(MemoryLength, IsFoundAgain) {
  for (double length : {3.0, 10.0}) {
    const MemoryLength found = memory_length(motion(length), elastic(), deepest);
    EXPECT_NEAR(found.mm / length, 1, 0.05);
    EXPECT_LT(found.after, 0.2 * found.before);
  }
}

TEST(MemoryLength, OfSpringsAsTheyAreIsLong) {
  const MemoryLength found = memory_length(motion(0), elastic(), deepest);
  EXPECT_TRUE(found.mm == 0 || found.mm > 10 * deepest) << found.mm;
}

}  // namespace
}  // namespace palpate::loop
