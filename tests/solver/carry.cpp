// What a bed of springs remembers goes to another mesh of the same rest shape.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tests/solver/origins.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

/// A block of 4 x 4 x 2 mm that may slide on a bed under it.
implicit::Model on_a_bed(int cells) {
  auto model = brick(uniform(-2, 2, 2 * cells), uniform(-2, 2, 2 * cells), uniform(0, 2, cells));
  model.materials = {material("neo_hookean", {0.0067})};
  implicit::RegionForce bed{{effect_named("support"), {0.005, 0.5, 0.4}}, {}};
  for (int n = 0; n < int(model.points.size()); ++n)
    if (model.points[n].z() < 1e-9) bed.points.push_back({n, 1, -Vector3d::UnitZ()});
  model.region_forces = {bed};
  return model;
}

Vector3d linear_slip(const Vector3d& x) { return {0.1 + 0.02 * x.x() - 0.01 * x.y(), 0.03 * x.y(), 0}; }

}  // namespace

/// A slip that is linear along the bed is the same on a mesh twice as fine.
TEST(Carry, TheSlipOfABedIsInterpolatedAlongIt) {
  const auto coarse = on_a_bed(1), fine = on_a_bed(2);
  auto state = implicit::rest_state(coarse);
  const auto& old_points = coarse.region_forces[0].points;
  for (std::size_t i = 0; i < old_points.size(); ++i)
    Eigen::Map<Vector3d>(&state.memory[3 * i]) = linear_slip(coarse.points[old_points[i].node]);
  const auto origins = origins_in(coarse, fine);
  ASSERT_EQ(origins.nodes.size(), fine.points.size());
  const auto carried = implicit::carried(coarse, state, fine, origins);
  const auto& points = fine.region_forces[0].points;
  ASSERT_EQ(carried.memory.size(), 3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LE((Eigen::Map<const Vector3d>(&carried.memory[3 * i]) - linear_slip(fine.points[points[i].node])).norm(), 1e-14) << fine.points[points[i].node].transpose();
}
