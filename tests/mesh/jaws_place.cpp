// Jaws by centre line and angle: straight tubes along Z and along Y, and a bent line.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <pipeline/mesh/jaws_place.hpp>

namespace palpate {
namespace {

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_TRUE(norm(a - b) <= 1e-12) << a[0] << ' ' << a[1] << ' ' << a[2]; }

TEST(JawsPlace, TurnsAboutTheTube) {
  const CentreLine line{{{0, 0, 0}, {0, 0, 50}}, {0, 50}, {25, 25}};
  const JawsPlace down = jaws_at(line, 20, 0), side = jaws_at(line, 20, 90);
  expect_near(down.centre, {0, 0, 20});
  expect_near(down.axis, {0, -1, 0});
  expect_near(side.axis, {1, 0, 0});  // Z × −Y
  expect_near(side.along, {0, 0, 1});
  EXPECT_EQ(clamp_lines(down), "centre_mm = [0, 0, 20]\naxis = [0, -1, 0]\nalong = [0, 0, 1]");
}

TEST(JawsPlace, ATubeAlongY) {
  const CentreLine line{{{0, 0, 0}, {0, 50, 0}}, {0, 50}, {25, 25}};
  expect_near(jaws_at(line, 20, 0).axis, {0, 0, -1});
}

TEST(JawsPlace, AtRightAnglesToABentTube) {
  const CentreLine line{{{0, 0, 0}, {0, 30, 40}}, {0, 50}, {25, 25}};
  const JawsPlace jaws = jaws_at(line, 25, 30);
  EXPECT_NEAR(dot(jaws.axis, jaws.along), 0, 1e-12);
  EXPECT_NEAR(norm(jaws.axis), 1, 1e-12);
  expect_near(jaws.centre, {0, 15, 20});
}

}  // namespace
}  // namespace palpate
