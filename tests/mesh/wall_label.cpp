// The wall's thickness and middle from a label of a tube that gets thicker along its length, in voxels of half a millimetre.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <palpate/errors.hpp>
#include <pipeline/mesh/wall_label.hpp>

namespace palpate {
namespace {

constexpr double inner = 11, length = 40, voxel = 0.5;

double thickness_at(double z) { return 1.2 + 0.8 * z / length; }

/// Label 3 is the wall; where `hole` says so there is none.
Labels tube_labels(const std::function<bool(const Vec3&)>& hole) {
  Labels labels;
  labels.grid.size = {60, 60, 81};
  labels.grid.lps_from_voxel.columns = {Vec3{voxel, 0, 0}, Vec3{0, voxel, 0}, Vec3{0, 0, voxel}};
  labels.grid.lps_from_voxel.origin = {-14.87, -14.71, -0.13};
  labels.voxels.assign(labels.grid.count(), 0);
  for (int k = 0; k < 81; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) {
        const Vec3 x = labels.grid.lps_from_voxel({double(i), double(j), double(k)});
        const double r = std::hypot(x[0], x[1]);
        if (r > inner && r < inner + thickness_at(x[2]) && !hole(x)) labels(i, j, k) = 3;
      }
  return labels;
}

/// Rings 2 mm apart at the lumen.
ShellMesh lumen() {
  ShellMesh mesh;
  const int around = 37, rings = 18;
  for (int r = 0; r <= rings; ++r)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * i / around;
      mesh.points.push_back({inner * std::cos(a), inner * std::sin(a), 2 + 2.0 * r});
    }
  for (int r = 0; r < rings; ++r)
    for (int i = 0; i < around; ++i) {
      const int a = r * around + i, b = r * around + (i + 1) % around;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, a + around}, {b, b + around, a + around}});
    }
  mesh.thickness_mm.assign(mesh.points.size(), 9);
  return mesh;
}

void expect_measured(const ShellMesh& mesh) {
  double worst = 0, mean = 0, off = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3& x = mesh.points[i];
    const double t = thickness_at(x[2]), error = mesh.thickness_mm[i] - t;
    worst = std::max(worst, std::abs(error));
    mean += error / static_cast<double>(mesh.points.size());
    off = std::max(off, std::abs(std::hypot(x[0], x[1]) - inner - t / 2));
  }
  EXPECT_TRUE(worst <= 0.6 * voxel) << worst;  // steps of a voxel at either side, smoothed
  EXPECT_TRUE(std::abs(mean) <= 0.1 * voxel) << mean;
  EXPECT_TRUE(off <= 0.4 * voxel) << off;
}

TEST(WallLabel, ThicknessAndMiddle) {
  ShellMesh mesh = lumen();
  const MeasuredWall wall = measure_wall(mesh, tube_labels([](const Vec3&) { return false; }), 3, 5);
  EXPECT_EQ(wall.measured, static_cast<int>(mesh.points.size()));
  EXPECT_EQ(wall.filled, 0);
  expect_measured(mesh);
}

TEST(WallLabel, AHoleIsFilledFromAround) {
  ShellMesh mesh = lumen();
  const MeasuredWall wall = measure_wall(mesh, tube_labels([](const Vec3& x) { return norm(x - Vec3{11.8, 0, 20}) < 3; }), 3, 5);
  EXPECT_GT(wall.filled, 0);
  EXPECT_EQ(wall.measured + wall.filled, static_cast<int>(mesh.points.size()));
  expect_measured(mesh);
}

TEST(WallLabel, AnotherLabelIsRefused) {
  ShellMesh mesh = lumen();
  EXPECT_THROW(measure_wall(mesh, tube_labels([](const Vec3&) { return false; }), 7, 5), Failure);
}

}  // namespace
}  // namespace palpate
