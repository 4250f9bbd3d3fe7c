// Which elements of a mesh are asked to be finer because of what has become of them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/remesh_marks.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

implicit::Model block() {
  auto model = brick(uniform(-2, 2, 4), uniform(-1, 1, 2), uniform(0, 2, 2));
  model.materials = {material("neo_hookean", {0.0067})};
  return model;
}

/// x → map(x).
template <class Map>
implicit::State moved(const implicit::Model& model, const Map& map) {
  auto state = implicit::rest_state(model);
  for (std::size_t n = 0; n < model.points.size(); ++n) state.nodal.segment<3>(4 * n) = map(model.points[n]) - model.points[n];
  return state;
}

Marks marks_of(const implicit::Model& model, const implicit::State& state, double finest_mm = 0.1) {
  RemeshRules rules;
  rules.finest_mm = finest_mm;
  return marks(model, state, {}, rules);
}

}  // namespace

TEST(RemeshMarks, MeanRatioOfKnownTetrahedra) {
  Eigen::Matrix<double, 3, 4> regular, corner;
  regular << 1, -1, -1, 1, 1, -1, 1, -1, 1, 1, -1, -1;
  corner << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_NEAR(mean_ratio(corner), 12 * std::cbrt(0.25) / 9, 1e-15);
  EXPECT_NEAR(mean_ratio(0.3 * corner), 12 * std::cbrt(0.25) / 9, 1e-15);
  EXPECT_NEAR(std::abs(mean_ratio(regular)), 1, 1e-15);
  corner(2, 3) = -1;
  EXPECT_LT(mean_ratio(corner), 0);
}

/// Where x > 0 the block is pulled to eight times its length along x, and stays as it is elsewhere.
TEST(RemeshMarks, ElementsThatLostTheirShape) {
  const auto model = block();
  const auto state = moved(model, [](const Vector3d& x) { return Vector3d(x.x() > 0 ? 8 * x.x() : x.x(), x.y(), x.z()); });
  const auto asked = marks_of(model, state);
  ASSERT_EQ(asked.longest_mm.size(), model.tets.size());
  EXPECT_EQ(asked.why, "elements had lost their shape");
  for (std::size_t t = 0; t < model.tets.size(); ++t) {
    double longest = 0;
    for (int a : model.tets[t])
      for (int b : model.tets[t]) longest = std::max(longest, (model.points[a] + state.displacement(a) - model.points[b] - state.displacement(b)).norm());
    const bool pulled = implicit::corners(model, model.tets[t]).row(0).mean() > 0;
    EXPECT_NEAR(asked.longest_mm[t], pulled ? longest / 2 : 0, 1e-12) << t;
  }
  EXPECT_TRUE(marks_of(model, state, 10).longest_mm.empty());  // no edge is longer than the finest
}

TEST(RemeshMarks, NoneForTurnsGrowthAndModestShear) {
  const auto model = block();
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(1.0, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_TRUE(marks_of(model, moved(model, [&](const Vector3d& x) -> Vector3d { return 3 * (Q * x); })).longest_mm.empty());
  EXPECT_TRUE(marks_of(model, moved(model, [](const Vector3d& x) { return Vector3d(x.x() + 0.8 * x.z(), x.y(), x.z()); })).longest_mm.empty());
}

namespace {

/// A plate with a flat tool on it that presses within `radius` of the middle; its curvature asks for nothing.
implicit::ContactSums pressed(implicit::Model& model, double radius) {
  model.tools = {contact::Tool{tool_named("plane"), {}, -Vector3d::UnitZ(), {0, 0, 2}, 1, {}}};
  implicit::ContactSums sums;
  sums.points.resize(model.faces.size() * contact::points_per_face);
  for (std::size_t f = 0; f < model.faces.size(); ++f)
    for (int q = 0; q < contact::points_per_face; ++q) {
      Vector3d x = Vector3d::Zero();
      for (int a = 0; a < 3; ++a) x += contact::quadrature[q].N[a] * model.points[model.faces[f][a]];
      if (x.z() > 2 - 1e-9 && std::hypot(x.x(), x.y()) < radius) sums.points[f * contact::points_per_face + q].pressure = 1;
    }
  return sums;
}

}  // namespace

/// Edges are as long as a part of half the contact's width where it is, and of that and the distance from it elsewhere.
TEST(RemeshMarks, AContactFewEdgesWide) {
  auto model = brick(uniform(-8, 8, 32), uniform(-8, 8, 32), uniform(0, 2, 2));
  model.materials = {material("neo_hookean", {0.0067})};
  const auto contact = pressed(model, 3);
  const auto state = implicit::rest_state(model);
  RemeshRules rules;
  rules.finest_mm = 0.1;
  const auto longest = std::sqrt(1.5);  // of a tetrahedron; √½ of a face on top
  rules.part_of_contact = 0.24;
  EXPECT_TRUE(marks(model, state, contact, rules).longest_mm.empty());  // 0.72 mm
  rules.part_of_contact = 0.23;
  const auto asked = marks(model, state, contact, rules);
  ASSERT_EQ(asked.longest_mm.size(), model.tets.size());
  EXPECT_EQ(asked.why, "faces under a tool were too coarse");
  int marked = 0;
  for (std::size_t t = 0; t < model.tets.size(); ++t) {
    const auto X = implicit::corners(model, model.tets[t]);
    double nearest = 1e300;
    for (int a = 0; a < 4; ++a) nearest = std::min(nearest, std::hypot(std::max(0.0, std::hypot(X(0, a), X(1, a)) - 3), 2 - X(2, a)));
    const double wish = 0.23 * (3 + nearest);
    constexpr double apart = 0.1;  // half of what points of contact are
    if (std::abs(wish - longest) > apart) {
      EXPECT_NEAR(asked.longest_mm[t], wish < longest ? wish : 0, apart) << X.rowwise().mean().transpose();
    }
    marked += asked.longest_mm[t] > 0;
  }
  EXPECT_LT(marked, static_cast<int>(model.tets.size()));
}
