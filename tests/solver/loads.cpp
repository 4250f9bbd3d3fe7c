// Gravity, forces, springs, paths and several tools: closed forms, balances, and an unloading that finds the way back.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

bool at_bottom(const Vector3d& x) { return x.z() < 1e-9; }

implicit::Model block(const char* law, std::vector<double> parameters) {
  auto model = brick(uniform(-5, 5, 6), uniform(-5, 5, 6), uniform(0, 6, 5));
  model.materials = {material(law, std::move(parameters))};
  return model;
}

struct Solved {
  implicit::State state;
  implicit::Equations equations;
  Vector3d loads;
};

Solved solve(const implicit::Model& model, const std::vector<double>& times) {
  implicit::Equilibrium equilibrium(model, 2);
  Solved s{implicit::rest_state(model), {}, {}};
  implicit::StepPlan plan{{0}};
  plan.times.insert(plan.times.end(), times.begin(), times.end());
  const double reached = run_steps(equilibrium, s.state, plan, [&](const implicit::Step& step) { s.equations = step.equations; });
  if (reached < times.back()) throw std::runtime_error(equilibrium.trouble().cause);
  s.loads = equilibrium.assembly().loads(s.state);
  return s;
}

Vector3d reaction(const implicit::Model& model, const Solved& s) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& p : model.prescribed) sum(p.component) += s.equations.residual(4 * p.node + p.component);
  return sum;
}

}  // namespace

TEST(Amplitude, IsLinearBetweenItsPointsAndConstantBeyond) {
  const Amplitude a{{{1, 0}, {3, 4}, {4, 2}}};
  EXPECT_EQ(a.at(0), 0);
  EXPECT_EQ(a.at(2), 2);
  EXPECT_EQ(a.at(3.5), 3);
  EXPECT_EQ(a.at(9), 2);
  EXPECT_EQ(Amplitude{}.at(0.3), 0.3);
}

TEST(Loads, AColumnSagsUnderItsWeight) {  // ν = 0, free to slide: u(h) = −ρ g h²/(2 E)
  auto model = block("hooke_linear", {0.02, 0.0});
  model.materials[0].density = 1000;
  model.gravity = {0, 0, -9.81};
  hold(model, 2, at_bottom);
  hold(model, 0, [](const Vector3d& x) { return x.x() < -5 + 1e-9; });
  hold(model, 1, [](const Vector3d& x) { return x.y() < -5 + 1e-9; });
  const auto s = solve(model, {0.5, 1});
  const double expected = -1000 * 1e-9 * 9.81 * 36 / (2 * 0.02), weight = 1000 * 1e-9 * 9.81 * 600;
  double mean = 0;
  int top = 0;
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].z() > 6 - 1e-9) {
      mean += s.state.displacement(i).z();
      ++top;
    }
  EXPECT_LE(std::abs(mean / top / expected - 1), 0.01);
  EXPECT_LE((s.loads - Vector3d(0, 0, -weight)).norm(), 1e-12 * weight);
  EXPECT_LE((reaction(model, s) + s.loads).norm(), 1e-8 * weight);
}

TEST(Loads, SpringsCarryAForce) {  // equal springs on the bottom alone: Σ k u = F, whatever the block does
  auto model = block("neo_hookean", {0.0067});
  const Vector3d force(0.01, -0.02, -0.05);
  std::vector<int> bottom, top;
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    if (at_bottom(model.points[i])) bottom.push_back(i);
    if (model.points[i].z() > 6 - 1e-9) top.push_back(i);
  }
  for (int node : bottom) model.springs.push_back({node, 0.01});
  for (int node : top) model.nodal_forces.push_back({node, force / top.size()});
  const auto s = solve(model, {0.25, 0.5, 0.75, 1});
  Vector3d pulled = Vector3d::Zero();
  for (int node : bottom) pulled += 0.01 * s.state.displacement(node);
  EXPECT_LE((pulled - force).norm(), 1e-7 * force.norm());
  EXPECT_LE(s.loads.norm(), 1e-7 * force.norm());
}

TEST(Loads, TwoToolsPinchABlock) {
  auto model = block("neo_hookean", {0.0067});
  for (int c = 0; c < 3; ++c) hold(model, c, at_bottom);
  for (double side : {-1.0, 1.0})
    model.tools.push_back({tool_named("ball"), {3.0}, Vector3d(-side, 0, 0), Vector3d(5 * side, 0.1, 4), 0.8, {}});
  const auto s = solve(model, {0.25, 0.5, 0.75, 1});
  const auto& tools = s.equations.contact.tools;
  EXPECT_GT(tools[0].force.x(), 0.01);
  EXPECT_LT(tools[1].force.x(), -0.01);
  EXPECT_LE((tools[0].force + tools[1].force + reaction(model, s)).norm(), 1e-8 * tools[0].force.norm());
}

TEST(Loads, UnloadingFindsTheWayBack) {  // an elastic organ and a frictionless tool remember nothing
  auto model = block("fung_demiray", {0.0067, 2});
  for (int c = 0; c < 3; ++c) hold(model, c, at_bottom);
  model.tools = {contact::Tool{tool_named("ball"), {3.0}, -Vector3d::UnitZ(), {0.1, 0.2, 6}, 2.0, Amplitude{{{0, 0}, {1, 1}, {2, 1}, {3, 0}}}}};
  const auto loaded = solve(model, {0.25, 0.5}), unloaded = solve(model, {0.25, 0.5, 0.75, 1, 2, 2.25, 2.5});
  const double force = -loaded.equations.contact.tools[0].force.z();
  EXPECT_GT(force, 0.01);
  EXPECT_LE(std::abs(-unloaded.equations.contact.tools[0].force.z() / force - 1), 1e-7);
  const auto back = solve(model, {0.5, 1, 1.5, 2, 2.5, 3});
  EXPECT_LE(back.state.nodal.norm(), 1e-6 * loaded.state.nodal.norm());
}
