// A face in contact: its tangent against differences of its residual, without friction, sticking and slipping; what it sums up.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/contact/tool_contact.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

constexpr double softness = 0.01;

struct Touching {
  contact::Tool tool{tool_named("ball"), {30.0}, -Vector3d::UnitZ(), Vector3d(0.4, 0.4, 0), 1.0, {}};
  std::array<Vector3d, 3> rest{Vector3d(0, 0, 0), Vector3d(1, 0.1, 0), Vector3d(0.2, 1.1, 0)}, now;
  std::array<double, contact::points_per_face> pressures;
  std::array<contact::Slip, contact::points_per_face> slips;

  explicit Touching(double friction, double lifted = 0) {
    rub(tool, friction);
    now = rest;
    for (auto& x : now) x += Vector3d(0.02, -0.01, 0.0085 - lifted);  // against the ball's tip, and pushed aside
    pressures.fill(0.05);
    for (int q = 0; q < contact::points_per_face; ++q)
      slips[q] = {contact::place(tool, 0, rest, q), Vector3d(0.001, -0.002, 0.0003)};
  }
  contact::Pose pose;

  contact::FaceContact operator()(const std::array<Vector3d, 3>& corners) const {
    contact::Face face{rest, corners, pressures.data(), tool.holds_on() ? slips.data() : nullptr};
    return contact::face_contact(tool, pose, face, softness);
  }
};

void expect_tangent(const Touching& touching) {
  const auto whole = touching(touching.now);
  ASSERT_TRUE(whole.touched);
  const double h = 1e-6;
  Eigen::Matrix<double, 9, 9> numeric;
  for (int i = 0; i < 9; ++i) {
    auto plus = touching.now, minus = touching.now;
    plus[i / 3](i % 3) += h;
    minus[i / 3](i % 3) -= h;
    numeric.col(i) = (touching(plus).residual - touching(minus).residual) / (2 * h);
  }
  EXPECT_LE((numeric - whole.tangent).norm(), 1e-6 * whole.tangent.norm());
}

}  // namespace

TEST(FaceContact, TangentIsTheDerivativeWithoutFriction) { expect_tangent(Touching(0)); }
TEST(FaceContact, TangentIsTheDerivativeWhileSlipping) { expect_tangent(Touching(0.05)); }
TEST(FaceContact, TangentIsTheDerivativeWhileSticking) { expect_tangent(Touching(std::numeric_limits<double>::infinity())); }

TEST(FaceContact, TangentIsTheDerivativeUnderATurnedTool) {
  Touching touching(std::numeric_limits<double>::infinity());
  touching.tool.spin = Vector3d(1, 2, 2) / 3;
  touching.tool.pivot = {0.002, 0.003, 30};  // near the ball's middle: it stays about where it is
  touching.pose = {0.001, 0.3};
  expect_tangent(touching);
}

TEST(FaceContact, WhatMovesWithATurningToolStays) {
  Touching touching(1);
  touching.tool.spin = Vector3d(1, 2, 2) / 3;
  touching.tool.pivot = {3, -2, 1};
  const contact::Pose later{0.7, 1.1};
  const auto Q = touching.tool.rotation(later.angle);
  auto moved = touching.now;
  for (auto& x : moved)
    x = Q * (x - touching.tool.first_contact - touching.tool.pivot) + touching.tool.pivot_now(later);
  const auto before = touching(touching.now);
  touching.pose = later;
  const auto after = touching(moved);
  ASSERT_GT(before.force.norm(), 0);
  EXPECT_LE((after.force - Q * before.force).norm(), 1e-9 * before.force.norm());
}

TEST(FaceContact, ShearStaysInCoulombsCone) {
  const Touching slipping(0.05), sticking(std::numeric_limits<double>::infinity());
  for (const auto& point : slipping(slipping.now).points)
    if (point.pressure > 0) {
      EXPECT_NEAR(point.shear.norm(), 0.05 * point.pressure, 1e-12);
      EXPECT_LE(std::abs(point.shear.dot(point.normal)), 1e-12);
    }
  bool beyond = false;
  for (const auto& point : sticking(sticking.now).points) beyond = beyond || point.shear.norm() > 0.05 * point.pressure;
  EXPECT_TRUE(beyond);
}

TEST(Contact, ATractionThatReachesOutHasItsTangent) {
  for (double lifted : {0.0, 0.1, 0.3}) {
    Touching touching(0, lifted);
    if (lifted > 0) touching.pressures.fill(0);
    touching.tool.tractions.push_back({effect_named("adhesion"), {0.5, 0.4}});
    expect_tangent(touching);
    EXPECT_EQ(touching(touching.now).area > 0, lifted == 0);
    if (lifted > 0) {
      EXPECT_GT(touching(touching.now).force.z(), 1e-6);  // towards the tool, which comes from above
    }
  }
}
