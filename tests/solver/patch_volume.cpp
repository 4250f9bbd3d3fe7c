// How well volume is kept: a known stretch is told, and an incompressible block keeps its volume the better the finer it is.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <solver/results.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

implicit::Model block(int cells) {
  auto model = brick(uniform(-5, 5, cells), uniform(-5, 5, cells), uniform(0, 5, cells / 2));
  model.materials = {material("neo_hookean", {0.0067})};
  for (int c = 0; c < 3; ++c) hold(model, c, [](const Vector3d& x) { return x.z() < 1e-9; });
  model.tools = {contact::Tool{tool_named("ball"), {6.0}, -Vector3d::UnitZ(), {0.1, 0.2, 5}, 0.5, {}}};
  return model;
}

}  // namespace

TEST(PatchVolume, OfAUniformStretch) {
  const auto model = block(4);
  auto state = implicit::rest_state(model);
  EXPECT_EQ(patch_volume_change(model, state), 0);
  for (std::size_t i = 0; i < model.points.size(); ++i) state.nodal.segment<3>(4 * i) = 0.1 * model.points[i];
  EXPECT_NEAR(patch_volume_change(model, state), 0.331, 1e-12);
}

TEST(PatchVolume, FallsWithMeshSize) {
  std::vector<double> changes;
  for (int cells : {4, 8, 12}) {
    const auto model = block(cells);
    implicit::Equilibrium equilibrium(model, 1);
    auto state = implicit::rest_state(model);
    for (double t : {0.5, 1.0}) ASSERT_TRUE(equilibrium.find(state, t));
    changes.push_back(patch_volume_change(model, state));
    std::printf("  %d cells: %.3e\n", cells, changes.back());
  }
  EXPECT_GT(changes.back(), 0);
  for (std::size_t i = 1; i < changes.size(); ++i) EXPECT_LT(changes[i], changes[i - 1]);
}
