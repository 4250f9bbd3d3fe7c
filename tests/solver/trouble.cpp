// A step that is not found says why: each of the causes, provoked.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <tests/verify/organs.hpp>

using namespace palpate;
using namespace palpate::verify;
using implicit::Cause;

namespace {

constexpr double mu = 0.0067;

implicit::Model block() {
  auto model = brick(uniform(-5, 5, 5), uniform(-5, 5, 5), uniform(0, 5, 4));
  model.materials = {material("neo_hookean", {mu})};
  return model;
}

void hold_bottom(implicit::Model& model) {
  for (int c = 0; c < 3; ++c) hold(model, c, [](const Vector3d& x) { return x.z() < 1e-9; });
}

contact::Tool ball(double depth) { return {tool_named("ball"), {2.0}, -Vector3d::UnitZ(), {0.1, 0.2, 5}, depth, {}}; }

implicit::Trouble trouble(const implicit::Model& model, const std::vector<double>& times, int most_cuts) {
  implicit::Equilibrium equilibrium(model, 1);
  auto state = implicit::rest_state(model);
  implicit::StepPlan plan{times};
  plan.most_cuts = most_cuts;
  const double reached = run_steps(equilibrium, state, plan, [](const implicit::Step&) {});
  EXPECT_LT(reached, times.back());
  std::printf("  at %g: %s, near (%.2f, %.2f, %.2f)\n", reached, equilibrium.trouble().cause.c_str(), equilibrium.trouble().place_mm.x(),
              equilibrium.trouble().place_mm.y(), equilibrium.trouble().place_mm.z());
  return equilibrium.trouble();
}

}  // namespace

TEST(Trouble, AnElementTurnsInsideOut) {  // the top is moved below the bottom
  auto model = block();
  hold_bottom(model);
  hold(model, 2, [](const Vector3d& x) { return x.z() > 5 - 1e-9; }, -6);
  const auto t = trouble(model, {0, 1}, 2);
  EXPECT_EQ(t.likely, Cause::element_inverted);
  EXPECT_NE(t.cause.find("tetrahedron"), std::string::npos);
}

TEST(Trouble, AToolIsTooFast) {  // through the block in one step
  auto model = block();
  hold_bottom(model);
  model.tools = {ball(12)};
  EXPECT_EQ(trouble(model, {0, 1}, 0).likely, Cause::tool_too_fast);
}

TEST(Trouble, ABodyIsNotHeld) {  // the second block, 20 mm to the right, floats; with a load on it, and without
  for (const double force : {0.0, 0.01}) {
    auto model = block();
    auto floating = block();
    for (auto& x : floating.points) x.x() += 20;
    const int node = model.points.size();
    append(model, floating);
    hold(model, 2, [](const Vector3d& x) { return x.z() < 1e-9 && x.x() < 6; });
    for (int c : {0, 1}) hold(model, c, [](const Vector3d& x) { return x.z() < 1e-9 && x.x() < 6; });
    model.nodal_forces = {{node, Vector3d(0, 0, force), 0}};
    model.tools = {ball(0.5)};
    const auto t = trouble(model, {0, 0.5, 1}, 1);
    EXPECT_EQ(t.likely, Cause::body_not_held);
    EXPECT_LE((t.place_mm - Vector3d(20, 0, 2.5)).norm(), 1e-9);
  }
}

TEST(Trouble, AHeldBodyIsNotCalledFree) {
  auto model = block();
  hold_bottom(model);
  EXPECT_TRUE(implicit::free_bodies(model).empty());
  auto sliding = block();
  hold(sliding, 2, [](const Vector3d& x) { return x.z() < 1e-9; });
  ASSERT_EQ(implicit::free_bodies(sliding).size(), 1u);
  EXPECT_EQ(implicit::free_bodies(sliding)[0].motions, 3);  // along x, along y, around z
}

TEST(Trouble, ALoadIsBeyondALimitPoint) {  // a thick sphere holds no more than 0.42 mu (inner stretch 1.83), here asked for 20 % more
  auto model = thick_sphere_octant(2, 4, 5, 5);
  model.materials = {material("neo_hookean", {mu})};
  for (int c : {0, 1, 2}) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  const auto pressure = [](double a) {
    const double b = std::cbrt(1 + (a * a * a - 1) / 8);
    return 2 * mu * (1 / b + 1 / (4 * std::pow(b, 4)) - 1 / a - 1 / (4 * std::pow(a, 4)));
  };
  implicit::FacePressure load{{}, 1.2 * pressure(1.83), 0};
  for (int f = 0; f < int(model.faces.size()); ++f) {
    const auto& face = model.faces[f];
    if (std::all_of(face.begin(), face.end(), [&](int node) { return model.points[node].norm() < 2 + 1e-6; })) load.faces.push_back(f);
  }
  model.pressures = {load};
  EXPECT_EQ(trouble(model, uniform(0, 1, 8), 6).likely, Cause::beyond_limit_point);
}
