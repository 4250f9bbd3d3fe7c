// Shells, nesting, and the located refusal of what bounds no volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <palpate/errors.hpp>
#include <pipeline/mesh/components.hpp>
#include <tests/mesh/shapes.hpp>

using namespace palpate;

namespace {
std::string refusal(const Surface& surface) {
  try {
    bodies_of(surface, closed_shells(surface));
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::check_failed);
    return failure.what();
  }
  return "";
}
const Surface ball = shapes::ball({0, 0, 0}, 10, 3);
}  // namespace

TEST(Components, VolumeOfABall) {
  const auto shells = closed_shells(shapes::ball({100, 200, -50}, 10, 4));
  ASSERT_EQ(shells.size(), 1);
  EXPECT_NEAR(shells[0].volume, 4.0 / 3 * std::numbers::pi * 1000, 0.005 * 4189);  // engineering: chords of 80·4³ triangles
}

TEST(Components, CavityIsAHole) {
  Surface surface = ball, inner = shapes::ball({1, 0, 0}, 5, 3);
  shapes::turn(inner);
  shapes::append(surface, inner);
  const auto shells = closed_shells(surface);
  const auto bodies = bodies_of(surface, shells);
  ASSERT_EQ(bodies.size(), 1);
  EXPECT_EQ(bodies[0].holes, std::vector<int>{1});
  EXPECT_NEAR(total_volume(shells, bodies), shells[0].volume * (1 - 1.0 / 8), 1e-9);
}

TEST(Components, InnerBodyOfAnotherRegionIsItsOwnAndAHole) {
  Surface surface = ball;
  shapes::append(surface, shapes::ball({1, 0, 0}, 5, 3, 2, "stone"));
  const auto shells = closed_shells(surface);
  const auto bodies = bodies_of(surface, shells);
  ASSERT_EQ(bodies.size(), 2);
  EXPECT_EQ(bodies[0].holes, std::vector<int>{1});
  EXPECT_EQ(bodies[1].region, 2);
  EXPECT_NEAR(total_volume(shells, bodies), shells[0].volume, 1e-9);
}

TEST(Components, IslandInACavityIsABody) {
  Surface surface = ball, cavity = shapes::ball({0, 0, 0}, 7, 3);
  shapes::turn(cavity);
  shapes::append(surface, cavity);
  shapes::append(surface, shapes::ball({0, 0, 0}, 3, 3));
  const auto bodies = bodies_of(surface, closed_shells(surface));
  ASSERT_EQ(bodies.size(), 2);
  EXPECT_EQ(bodies[0].holes, std::vector<int>{1});
  EXPECT_TRUE(bodies[1].holes.empty());
}

TEST(Components, WhatBoundsNoVolumeIsRefusedWithItsPlace) {
  Surface open = ball;
  open.triangles.pop_back();
  EXPECT_NE(refusal(open).find("open"), std::string::npos);
  EXPECT_NE(refusal(open).find("mm"), std::string::npos);

  Surface inside_out = ball;
  shapes::turn(inside_out);
  EXPECT_NE(refusal(inside_out).find("inside out"), std::string::npos);

  Surface mixed = ball;
  std::swap(mixed.triangles[7][0], mixed.triangles[7][1]);
  EXPECT_NE(refusal(mixed).find("face opposite sides"), std::string::npos);

  Surface doubled = ball;
  shapes::append(doubled, shapes::ball({1, 0, 0}, 5, 3));
  EXPECT_NE(refusal(doubled).find("same region"), std::string::npos);
}
