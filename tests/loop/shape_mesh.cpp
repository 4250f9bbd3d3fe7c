// The meshes of simple shapes: positive tetrahedra, their volume, a closed boundary, a base.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <loop/forward/shape_mesh.hpp>

using namespace palpate;
using namespace palpate::loop;

namespace {

double volume(const TetMesh& mesh, const std::array<int, 4>& t) {
  const auto& x = mesh.points;
  return dot(x[t[1]] - x[t[0]], cross(x[t[2]] - x[t[0]], x[t[3]] - x[t[0]])) / 6;
}

/// Sums of volumes, and of boundary areas as vectors, which vanish where the boundary is closed.
void expect_sound(const Specimen& specimen, double expected, double tolerance) {
  const TetMesh mesh = shape_mesh(specimen, {6, -3, specimen.size_mm[2]}, 2.0);
  double total = 0, smallest = 1e300, base = 0;
  for (const auto& t : mesh.tets) {
    total += volume(mesh, t);
    smallest = std::min(smallest, volume(mesh, t));
  }
  Vec3 open{0, 0, 0};
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& c = mesh.faces[f];
    const Vec3 area = 0.5 * cross(mesh.points[c[1]] - mesh.points[c[0]], mesh.points[c[2]] - mesh.points[c[0]]);
    open = open + area;
    if (mesh.face_region[f] == 2) base -= area[2];
  }
  EXPECT_GT(smallest, 0);
  EXPECT_TRUE(std::abs(total / expected - 1) <= tolerance) << total;
  EXPECT_TRUE(norm(open) <= 1e-9 * expected);
  EXPECT_TRUE(std::abs(base * specimen.size_mm[2] / expected - 1) <= tolerance) << base;
}

}  // namespace

TEST(ShapeMesh, Block) {
  Specimen block;
  block.shape = "block";
  block.size_mm = {40, 30, 20};
  expect_sound(block, 40.0 * 30 * 20, 1e-12);
}

TEST(ShapeMesh, Cylinder) {
  Specimen cylinder;
  cylinder.shape = "cylinder";
  cylinder.size_mm = {50, 50, 20};
  expect_sound(cylinder, M_PI * 25 * 25 * 20, 0.03);  // a polygon in a circle
}

TEST(ShapeMesh, WidenedKeepsWhatIsWithin) {
  Specimen block;
  block.shape = "block";
  block.size_mm = {40, 30, 20};
  const TetMesh own = shape_mesh(block, {6, -3, 20}, 2.0), wide = shape_mesh(block, {6, -3, 20}, 2.0, 50);
  double far = 0;
  for (const Vec3& p : wide.points) far = std::max(far, p[0]);
  EXPECT_TRUE(std::abs(far - 56) <= 1e-9) << far;
  for (const Vec3& p : own.points)
    EXPECT_TRUE(std::any_of(wide.points.begin(), wide.points.end(), [&](const Vec3& q) { return norm(p - q) < 1e-9; })) << p[0] << " " << p[1] << " " << p[2];
}
