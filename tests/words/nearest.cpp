// The nearest name by edit distance.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/nearest.hpp>

#include <gtest/gtest.h>

using palpate::nearest_name;

TEST(Nearest, FindsTheMisspelt) {
  EXPECT_EQ(nearest_name("neo_hokean", {"hooke", "neo_hookean", "fung_demiray"}), "neo_hookean");
  EXPECT_EQ(nearest_name("radius", {"depth_mm", "radius_mm"}), "radius_mm");
  EXPECT_EQ(nearest_name("anything", {}), "");
}
