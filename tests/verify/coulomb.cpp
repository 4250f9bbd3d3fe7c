// Coulomb: a block pressed by N on a plane and pulled sideways: the tangential force at gross slip is μ N; below it sticks.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

/// Pressed down by 0.4 mm until t = 1, then pulled along x by up to 4 mm at t = 5.
implicit::Model pulled_block(double friction) {
  auto model = brick(uniform(-5, 5, 7), uniform(-5, 5, 7), uniform(0, 4, 3));
  model.materials = {material("neo_hookean", {0.0067})};
  model.amplitudes.push_back({{{0, 0}, {1, 1}}});
  model.amplitudes.push_back({{{1, 0}, {5, 1}}});
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].z() > 4 - 1e-9)
      for (int c = 0; c < 3; ++c) model.prescribed.push_back({int(i), c, c == 2 ? -0.4 : c == 0 ? 4.0 : 0.0, c == 2 ? 1 : 2});
  contact::Tool plane{tool_named("flat_punch"), {40.0, 0.5}, Vector3d::UnitZ(), Vector3d::Zero(), 0.0, {}};
  rub(plane, friction);
  model.tools = {plane};
  return model;
}

struct Row {
  double time, pull, press;
  double slid;  ///< mean motion of the bottom's middle, mm
};

double slid(const implicit::Model& model, const implicit::State& state) {
  double sum = 0;
  int nodes = 0;
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].z() < 1e-9 && model.points[i].head<2>().norm() < 3) {
      sum += state.displacement(i).x();
      ++nodes;
    }
  return sum / nodes;
}

std::vector<Row> rows(const implicit::Model& model, std::vector<double> times) {
  implicit::Equilibrium equilibrium(model, 2);
  auto state = implicit::rest_state(model);
  std::vector<Row> list;
  const double reached = run_steps(equilibrium, state, {times}, [&](const implicit::Step& step) {
    if (step.index == 0) return;
    const Vector3d force = step.equations.contact.tools[0].force;
    list.push_back({step.state.time, -force.x(), force.z(), slid(model, step.state)});
  });
  if (reached < times.back()) throw std::runtime_error(equilibrium.trouble().cause);
  return list;
}

}  // namespace

TEST(Coulomb, AtGrossSlipThePullIsMuTimesThePress) {
  for (double friction : {0.1, 0.3}) {
    const auto list = rows(pulled_block(friction), {0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5});
    const Row& last = list.back();
    std::printf("  mu %.1f: pull %.5f N, press %.5f N, ratio %.4f, slid %.2f mm\n", friction, last.pull, last.press, last.pull / last.press, last.slid);
    EXPECT_GT(last.press, 0.05);
    EXPECT_GT(last.slid, 3);
    EXPECT_LE(std::abs(last.pull / last.press / friction - 1), 0.01);
  }
}

TEST(Coulomb, BelowItSticks) {
  const auto list = rows(pulled_block(0.8), {0, 0.5, 1, 1.1});
  const Row &pressed = list[list.size() - 2], &last = list.back();
  std::printf("  pull %.5f N of %.5f N that friction can carry, slid %.5f mm\n", last.pull, 0.8 * last.press, last.slid - pressed.slid);
  EXPECT_LT(last.pull, 0.9 * 0.8 * last.press);
  EXPECT_GT(last.pull, 0.01 * last.press);
  EXPECT_LE(std::abs(last.slid - pressed.slid), 0.01 * 0.1);  // of the top's 0.1 mm
}
