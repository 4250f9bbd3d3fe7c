// Distances of tools to points where they can be told by hand, inside and outside; a tool turned about its axis.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <solver/contact/tool_contact.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using Eigen::Vector3d;

namespace {

struct Known {
  Vector3d x;
  double g;
  Vector3d n;
};

void expect(const std::string& kind, const std::vector<double>& parameters, const std::vector<Known>& list) {
  const auto shape = verify::tool_named(kind);
  for (const auto& [x, g, n] : list) {
    const auto d = shape.distance(x, parameters);
    EXPECT_LE(std::abs(d.g - g), 1e-12) << kind << " at " << x.transpose();
    EXPECT_LE((d.n - n).norm(), 1e-12) << kind << " at " << x.transpose();
  }
}

const Vector3d X = Vector3d::UnitX(), Y = Vector3d::UnitY(), Z = Vector3d::UnitZ();

}  // namespace

TEST(Tools, Plane) { expect("plane", {}, {{{7, -3, -2}, 2, -Z}, {{1, 2, 5}, -5, -Z}}); }

TEST(Tools, FlatPunch) {  // radius 3, edge 1
  expect("flat_punch", {3, 1}, {{{1, 1, -2}, 2, -Z}, {{0, 0, 0.5}, -0.5, -Z}, {{0, 5, 9}, 2, Y}, {{2.5, 0, 9}, -0.5, X},
                                {{2 + 3, 0, 1 - 4}, 4, {0.6, 0, -0.8}}, {{2 + 0.3, 0, 1 - 0.4}, -0.5, {0.6, 0, -0.8}}});
}

TEST(Tools, LyingCylinder) {  // radius 3, length 20, edge 1: core of radius 2 and half length 9 about (·, 0, 3)
  expect("cylinder", {3, 20, 1}, {{{4, 0, -2}, 2, -Z}, {{-4, 3, 7}, 2, {0, 0.6, 0.8}}, {{-4, 0, 1}, -1, -Z}, {{-15, 0, 3.5}, 5, -X},
                                  {{9.5, 0, 3}, -0.5, X}, {{9 + 4, 0, 1 - 3}, 4, {0.8, 0, -0.6}}, {{-9 - 0.4, 2.3, 3}, -0.5, {-0.8, 0.6, 0}}});
}

TEST(Tools, Box) {  // 10 × 20 × 6, edges 1: core |x| ≤ 4, |y| ≤ 9, 1 ≤ z ≤ 5
  expect("box", {10, 20, 6, 1}, {{{3, -8, -2}, 2, -Z}, {{3, 8, 0.25}, -0.25, -Z}, {{-7, 0, 3}, 2, -X}, {{0, 9.9, 3}, -0.1, Y}, {{0, 0, 8}, 2, Z},
                                 {{4 + 3, 2, 1 - 4}, 4, {0.6, 0, -0.8}}, {{3.5, 0, 3}, -1.5, X},
                                 {{4 + 2, -9 - 3, 1 - 6}, 6, {2.0 / 7, -3.0 / 7, -6.0 / 7}}, {{4.3, 0, 0.6}, -0.5, {0.6, 0, -0.8}}});
}

TEST(Tools, RoundedPunch) {  // radius 7, dome 14, edge 1: the rim of the core lies at rho = 6, 13² = 6² + 133
  const double rim = 14 - std::sqrt(133.0), c = std::sqrt(133.0) / 13, s = 6.0 / 13;
  const Vector3d tilted(s, 0, -c), rim_point(6, 0, rim);
  expect("rounded_punch", {7, 14, 1}, {{{0, 0, -2}, 2, -Z}, {{0, 0, 1.5}, -1.5, -Z}, {{0, 9, 20}, 2, Y}, {{-5, 0, 20}, -2, -X},
                                       {rim_point + 3 * tilted, 2, tilted},                               // where dome and edge meet
                                       {Vector3d(0, 0, 14) + 16 * Vector3d(0.28, 0, -0.96), 2, {0.28, 0, -0.96}},  // on the dome
                                       {rim_point + 5 * Vector3d(0.8, 0, -0.6), 4, {0.8, 0, -0.6}}});     // around the edge
  for (double z : {-1.0, 0.3, 2.0, 9.0})  // as flat as its radius is large, as round as a rod
    for (double x : {0.5, 2.0, 2.9, 3.5}) {
      const auto distance = [&](const char* kind, std::vector<double> p) { return verify::tool_named(kind).distance({x, 0, z}, p).g; };
      EXPECT_NEAR(distance("rounded_punch", {3, 3, 3}), distance("rod", {3}), 1e-12);
      EXPECT_NEAR(distance("rounded_punch", {3, 1e5, 1}), distance("flat_punch", {3, 1}), 1e-4);
    }
}

TEST(Tools, AcrossTurnsTheShape) {
  contact::Tool tool{verify::tool_named("box"), {2, 20, 6, 0.5}, Vector3d(0, 0.6, -0.8), Vector3d(1, 2, 3), 1, {}};
  for (const Vector3d& across : {X, Vector3d(-1, 2, 0.5), Vector3d(0, 1, 0)}) {
    tool.across = across;
    const Vector3d x = (across - across.dot(tool.axis) * tool.axis).normalized();
    EXPECT_LE((tool.frame().transpose() * tool.frame() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_GT(tool.frame().determinant(), 0);
    const auto d = tool.distance(tool.first_contact + 0.5 * tool.axis + 5 * x - 3 * tool.axis, 0.5);
    EXPECT_LE(std::abs(d.g - 4), 1e-12);  // half the width is 1
    EXPECT_LE((d.n - x).norm(), 1e-12);
    EXPECT_LE(std::abs(tool.distance(tool.first_contact + 13 * x.cross(tool.axis) - 3 * tool.axis, 0).g - 3), 1e-12);
  }
}
