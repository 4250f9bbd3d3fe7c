// An arch that snaps through under a load finds the other side, where the same arch pushed by a motion says it is.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <tests/verify/organs.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

/// 20 mm long, 1 mm thick, its middle 3 mm higher than its ends, which are held.
implicit::Model arch() {
  auto model = brick(uniform(-10, 10, 20), uniform(0, 2, 1), uniform(0, 1, 2));
  for (auto& x : model.points) x.z() += 3 * (1 - x.x() * x.x() / 100);
  model.materials = {material("neo_hookean", {0.0067})};
  for (int c : {0, 1, 2}) hold(model, c, [](const Vector3d& x) { return std::abs(x.x()) > 10 - 1e-9; });
  return model;
}

int crown(const implicit::Model& model) {
  for (int i = 0; i < static_cast<int>(model.points.size()); ++i)
    if (std::abs(model.points[i].x()) < 1e-9 && model.points[i].z() > 4 - 1e-9) return i;
  return -1;
}

}  // namespace

TEST(Drag, AnArchSnapsThrough) {
  constexpr double load = 1.5e-3;  // N, on the crown
  auto loaded = arch();
  const int node = crown(loaded);
  ASSERT_GE(node, 0);
  loaded.nodal_forces = {{node, Vector3d(0, 0, -load), 0}};
  implicit::Equilibrium equilibrium(loaded, 1);
  auto snapped = implicit::rest_state(loaded);
  ASSERT_TRUE(equilibrium.find(snapped, 0.1));
  const auto found = equilibrium.find_by_drag(snapped, 1);
  ASSERT_TRUE(found) << equilibrium.trouble().cause;
  EXPECT_LE(found->residuals.back(), 1e-9);  // nothing is left of the drag
  const double sinks = -snapped.nodal(4 * node + 2);
  EXPECT_GE(sinks, 4);  // the crown hangs below the ends

  auto moved = arch();
  moved.prescribed.push_back({node, 2, -sinks, 0});
  implicit::Equilibrium pushing(moved, 1);
  auto pushed = implicit::rest_state(moved);
  double force = 0;
  const double reached = run_steps(pushing, pushed, {uniform(0, 1, 24)}, [&](const implicit::Step& step) {
    if (step.index > 0) force = -step.equations.residual(4 * node + 2);
  });
  ASSERT_EQ(reached, 1) << pushing.trouble().cause;
  std::printf("  sinks %.4f mm under %.4g N after %d iterations; pushed there it takes %.8g N\n", sinks, load, found->iterations, force);
  EXPECT_LE(std::abs(force / load - 1), 1e-6);
}
