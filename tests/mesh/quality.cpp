// Measures of tetrahedra whose shape is known.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include <pipeline/mesh/quality.hpp>

using namespace palpate;

namespace {
constexpr double round_off = 1e-12;
const Corners regular = {Vec3{1, 1, 1}, Vec3{-1, -1, 1}, Vec3{-1, 1, -1}, Vec3{1, -1, -1}};
const Corners corner = {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0, 2, 0}, Vec3{0, 0, 2}};
const Corners flat = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}};
Corners turned(Corners x) {
  std::swap(x[0], x[1]);
  return x;
}
}  // namespace

TEST(Quality, RegularTetrahedron) {
  ASSERT_GT(jacobian(regular), 0);
  for (double angle : dihedral_degrees(regular)) EXPECT_NEAR(angle, std::acos(1.0 / 3) * 180 / std::numbers::pi, 1e-10);
  EXPECT_NEAR(smallest_dihedral_sine(regular), std::sqrt(8.0) / 3, round_off);
  EXPECT_NEAR(radius_ratio(regular), 1, round_off);
  EXPECT_NEAR(scaled_jacobian(regular), 1, round_off);
}

TEST(Quality, CornerOfACube) {
  // Three right angles at the corner; acos(1/√3) at the others. r = a/(3+√3), R = a√3/2.
  const auto angles = dihedral_degrees(corner);
  for (int e : {0, 1, 2}) EXPECT_NEAR(angles[e], 90, 1e-10);
  for (int e : {3, 4, 5}) EXPECT_NEAR(angles[e], std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi, 1e-10);
  EXPECT_NEAR(smallest_dihedral_sine(corner), std::sqrt(2.0 / 3), round_off);
  EXPECT_NEAR(radius_ratio(corner), 3 * (1 / (3 + std::sqrt(3.0))) / (std::sqrt(3.0) / 2), round_off);
  EXPECT_NEAR(scaled_jacobian(corner), 8 * std::sqrt(2.0) / (2 * 8), round_off);  // largest product at the other corners: 2·2√2·2√2
  EXPECT_NEAR(jacobian(corner), 8, round_off);
}

TEST(Quality, FlatAndInvertedAreNotGood) {
  EXPECT_EQ(jacobian(flat), 0);
  EXPECT_NEAR(radius_ratio(flat), 0, round_off);
  EXPECT_LE(smallest_dihedral_sine(flat), 0);
  EXPECT_LT(jacobian(turned(regular)), 0);
  EXPECT_LT(scaled_jacobian(turned(regular)), 0);
  EXPECT_LT(radius_ratio(turned(regular)), 0);
  EXPECT_LT(smallest_dihedral_sine(turned(corner)), 0);
}

TEST(Quality, TableCountsEveryAngleAndFindsTheWorst) {
  TetMesh mesh;
  mesh.points = {regular[0], regular[1], regular[2], regular[3], corner[0], corner[1], corner[2], corner[3]};
  mesh.tets = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  const QualityTable table = quality_of(mesh);
  EXPECT_EQ(table.worst_tet, 1);
  EXPECT_EQ(table.dihedral_histogram[7], 6);  // 70.5°
  EXPECT_EQ(table.dihedral_histogram[5], 3);  // 54.7°
  EXPECT_NEAR(table.largest_dihedral_deg, 90, 1e-10);
  EXPECT_NEAR(table.smallest_jacobian_mm3, 8, round_off);
}

TEST(Quality, SpreadIsOrderStatistics) {
  std::vector<double> values;
  for (int i = 200; i > 0; --i) values.push_back(i);
  const Spread spread = spread_of(values);
  EXPECT_EQ(spread.min, 1);
  EXPECT_EQ(spread.one_percent, 3);
  EXPECT_EQ(spread.median, 101);
}
