// Newton's residuals fall quadratically near the end, in a contact problem at large strain; a failed step leaves the state untouched.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <tests/solver/newtons_order.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

implicit::Model pressed_block(const char* law, std::vector<double> parameters) {
  auto model = brick(uniform(-5, 5, 8), uniform(-5, 5, 8), uniform(0, 6, 6));
  model.materials = {material(law, std::move(parameters))};
  for (int c = 0; c < 3; ++c) hold(model, c, [](const Vector3d& x) { return x.z() < 1e-9; });
  model.tools = {contact::Tool{tool_named("ball"), {3.0}, -Vector3d::UnitZ(), {0.1, 0.2, 6}, 1.5, {}}};
  return model;
}

}  // namespace

TEST(Newton, ResidualsFallQuadratically) {
  const auto model = pressed_block("fung_demiray", {0.0067, 2});
  implicit::Equilibrium equilibrium(model, 2);
  implicit::State state = implicit::rest_state(model);
  for (double load : {0.1, 0.2, 0.3}) ASSERT_TRUE(equilibrium.find(state, load));
  const auto found = equilibrium.find(state, 0.4);
  ASSERT_TRUE(found);
  expect_newtons_order(found->residuals);
}

TEST(Newton, AFailedStepLeavesTheStateUntouched) {
  auto model = pressed_block("neo_hookean", {0.0067});
  model.tools[0].depth = 15;
  implicit::Equilibrium equilibrium(model, 1);
  implicit::State state = implicit::rest_state(model);
  ASSERT_TRUE(equilibrium.find(state, 0.01));
  const Eigen::VectorXd before = state.nodal;
  EXPECT_FALSE(equilibrium.find(state, 1.0));
  EXPECT_EQ(before, state.nodal);
  EXPECT_FALSE(equilibrium.trouble().cause.empty());
}

TEST(Newton, ThreadsDoNotChangeTheForce) {
  const auto model = pressed_block("mooney_rivlin", {0.002, 0.00135});
  std::vector<double> forces;
  for (int threads : {1, 2}) {
    implicit::Equilibrium equilibrium(model, threads);
    implicit::State state = implicit::rest_state(model);
    implicit::Found found;
    for (double load : {0.2, 0.4}) {
      auto step = equilibrium.find(state, load);
      ASSERT_TRUE(step);
      found = std::move(*step);
    }
    forces.push_back(-found.equations.contact.tools[0].force.z());
  }
  EXPECT_GT(forces[0], 0);
  EXPECT_LE(std::abs(forces[0] - forces[1]), 1e-8 * forces[0]);
}
