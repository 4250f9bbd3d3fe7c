// A neo-Hookean block between frictionless flat tools is in uniaxial compression: F = μ (1/λ² − λ) A (Treloar 1943), to any depth.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/equilibrium.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

constexpr double side = 4, mu = 0.0067, depth = 1.2;

/// A cube of 4 mm, sliding on the planes x = 0 and y = 0.
implicit::Model block(int cells = 3) {
  auto model = brick(uniform(0, side, cells), uniform(0, side, cells), uniform(0, side, cells));
  model.materials = {material("neo_hookean", {mu})};
  for (int c : {0, 1}) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  return model;
}

void hold_bottom(implicit::Model& model) {
  hold(model, 2, [](const Vector3d& x) { return x.z() < 1e-9; });
}

/// In front of the block's top, aimed at the middle of it.
contact::Tool above(const char* kind, std::vector<double> parameters, double way = depth) {
  return {tool_named(kind), std::move(parameters), -Vector3d::UnitZ(), {side / 2, side / 2, side}, way, {}};
}

struct Pressed {
  implicit::State state;
  std::vector<Vector3d> forces;  ///< of the tools on the block
};

Pressed press(const implicit::Model& model) {
  implicit::Equilibrium equilibrium(model, 1);
  Pressed pressed{implicit::rest_state(model), {}};
  for (int step = 1; step <= 4; ++step) {
    const auto found = equilibrium.find(pressed.state, step / 4.0);
    if (!found) throw std::runtime_error(equilibrium.trouble().cause);
    pressed.forces.clear();
    for (const auto& tool : found->equations.contact.tools) pressed.forces.push_back(tool.force);
  }
  return pressed;
}

double uniaxial(double stretch) { return mu * (1 / (stretch * stretch) - stretch) * side * side; }

/// Height of a corner's column under the pressed block, of its height at rest.
double stretch_of(const implicit::Model& model, const implicit::State& state) {
  double top = 0, bottom = 0;
  for (int i = 0; i < int(model.points.size()); ++i)
    if (model.points[i].head<2>().norm() < 1e-9) {
      if (model.points[i].z() > side - 1e-9) top = state.displacement(i).z();
      if (model.points[i].z() < 1e-9) bottom = state.displacement(i).z();
    }
  return 1 + (top - bottom) / side;
}

void expect_uniaxial(const implicit::Model& model, const Pressed& pressed) {
  const double stretch = stretch_of(model, pressed.state), force = -pressed.forces[0].z(), wanted = 1 - depth / side;
  std::printf("  stretch %.5f (asked %.5f): force over mu (1/l^2 - l) A %.8f, by the asked stretch %.5f\n", stretch, wanted,
              force / uniaxial(stretch), force / uniaxial(wanted));
  EXPECT_LE(std::abs(force / uniaxial(stretch) - 1), 1e-6);  // the block's own stretch: Newton's tolerance
  EXPECT_LE(std::abs(force / uniaxial(wanted) - 1), 0.01);   // the tool's way: the gap that the contact may leave
  EXPECT_LE(pressed.forces[0].head<2>().norm(), 1e-12);
}

}  // namespace

TEST(PressedFlat, ByAPlane) {
  auto model = block();
  hold_bottom(model);
  model.tools = {above("plane", {})};
  expect_uniaxial(model, press(model));
}

TEST(PressedFlat, ByABoxThatOverhangs) {
  auto model = block();
  hold_bottom(model);
  model.tools = {above("box", {14, 14, 5, 0.5})};
  expect_uniaxial(model, press(model));
}

TEST(PressedFlat, ByAPairOfJaws) {
  auto model = block(5);  // two tools leave two gaps, each in proportion to the faces
  for (int i = 0; i < int(model.points.size()); ++i) model.springs.push_back({i, 1e-9});
  model.tools = {above("box", {14, 14, 5, 0.5}, depth / 2), above("box", {14, 14, 5, 0.5}, depth / 2)};
  model.tools[1].axis *= -1;
  model.tools[1].first_contact.z() = 0;
  const auto pressed = press(model);
  expect_uniaxial(model, pressed);
  EXPECT_LE((pressed.forces[0] + pressed.forces[1]).norm(), 1e-6 * pressed.forces[0].norm());
}

TEST(PressedFlat, ABarTurnedByAcrossPressesAlike) {  // the block and its mesh are symmetric in x and y
  std::vector<double> forces;
  const double shallow = 0.6;
  for (const Vector3d& across : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY())}) {
    auto model = block(4);
    hold_bottom(model);
    model.tools = {above("box", {2, 20, 5, 0.5}, shallow)};
    model.tools[0].across = across;
    forces.push_back(-press(model).forces[0].z());
  }
  std::printf("  force of a bar along y %.8g N, along x %.8g N\n", forces[0], forces[1]);
  EXPECT_GT(forces[0], 0);
  EXPECT_LE(forces[0], uniaxial(1 - shallow / side));
  EXPECT_LE(std::abs(forces[1] / forces[0] - 1), 1e-6);
}

TEST(PressedFlat, ALyingCylinderAndADomedPunchPressLessThanAPlane) {
  const double plane = uniaxial(1 - depth / side);
  for (auto tool : {above("cylinder", {3, 20, 0.25}), above("rounded_punch", {1.5, 3, 0.25})}) {
    auto model = block(4);
    hold_bottom(model);
    model.tools = {tool};
    const double force = -press(model).forces[0].z();
    std::printf("  %s: %.3f of the plane's force\n", tool.shape.entry.name.c_str(), force / plane);
    EXPECT_GT(force, 0.1 * plane);
    EXPECT_LT(force, plane);
  }
}
