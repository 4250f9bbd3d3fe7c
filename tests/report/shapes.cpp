// Skins of tetrahedra, tools at the end of their way, views that hold everything.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include <pipeline/report/boundary.hpp>
#include <pipeline/report/picture.hpp>
#include <pipeline/report/tool_shape.hpp>

using namespace palpate;

TEST(Boundary, OfTwoTetrahedraAndOfOneOfThem) {
  const std::vector<std::array<int, 4>> tets{{0, 1, 2, 3}, {1, 2, 3, 4}};
  const auto both = boundary_faces(tets, {true, true});
  EXPECT_EQ(both.size(), 6u);
  EXPECT_TRUE(std::none_of(both.begin(), both.end(), [](const BoundaryFace& face) { return face.inner; }));
  const auto one = boundary_faces(tets, {false, true});
  EXPECT_EQ(one.size(), 4u);
  EXPECT_EQ(std::count_if(one.begin(), one.end(), [](const BoundaryFace& face) { return face.inner; }), 1);
  EXPECT_TRUE(std::all_of(one.begin(), one.end(), [](const BoundaryFace& face) { return face.tet == 1; }));
}

TEST(Boundary, FacesOutward) {  // the faces of a tetrahedron of positive volume enclose it: Σ x0·(x1×x2)/6 = 1/6
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double volume = 0;
  for (const auto& face : boundary_faces({{0, 1, 2, 3}}, {true}))
    volume += dot(x[face.points[0]], cross(x[face.points[1]], x[face.points[2]])) / 6;
  EXPECT_NEAR(volume, 1.0 / 6, 1e-15);
}

TEST(ToolShape, ReachesToItsTipAndIsAsWideAsItsRadius) {
  const Vec3 axis = unit({1, 2, -2}), tip{3, 4, 5}, sideways = unit(cross(axis, {0, 0, 1}));
  for (const char* kind : {"ball", "rod", "flat_punch"}) {
    const Tool tool{kind, 2.5, 0.25, tip, axis};
    double foremost = -1e9, widest = 0;
    for (const auto& points : {tool_surface(tool).points, tool_section(tool, sideways)})
      for (const Vec3& p : points) {
        const double along = dot(p - tip, axis);
        foremost = std::max(foremost, along);
        widest = std::max(widest, norm(p - tip - along * axis));
      }
    EXPECT_NEAR(foremost, 0, 1e-12) << kind;
    EXPECT_NEAR(widest, 2.5, 1e-3) << kind;
  }
}

TEST(View, HoldsAllPoints) {
  const std::vector<Vec3> points{{0, 0, 0}, {10, 1, 2}, {-3, 7, 40}};
  const View view = fit_view(points, {1, 1, 0.3}, {0, 0, 1});
  const Vec3 right = unit(cross(view.toward, view.up));
  for (const Vec3& p : points) {
    EXPECT_LE(std::abs(dot(p - view.centre, right)), view.width_mm / 2);
    EXPECT_LE(std::abs(dot(p - view.centre, view.up)), view.height_mm / 2);
  }
}
