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
  for (const char* kind : {"ball", "rod", "flat_punch", "rounded_punch"}) {
    Tool tool{{}, -1, 0, tip, axis, sideways};
    ASSERT_TRUE(shape_tool({{"kind", kind}, {"radius_mm", 2.5}, {"edge_radius_mm", 0.25}, {"dome_radius_mm", 6}}, 100, tool));
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

/// How far points reach from the tip to both sides along a direction.
std::array<double, 2> reach(const std::vector<Vec3>& points, const Vec3& tip, const Vec3& direction) {
  std::array<double, 2> ends{1e9, -1e9};
  for (const Vec3& p : points) ends = {std::min(ends[0], dot(p - tip, direction)), std::max(ends[1], dot(p - tip, direction))};
  return ends;
}

TEST(ToolShape, BlocksAndCylindersLieAcrossAndAreClosed) {
  const Vec3 axis = unit({1, 2, -2}), tip{3, 4, 5}, across = unit(cross(axis, {0, 0, 1})), third = cross(axis, across);
  struct Expected {
    Json json;
    double across, third, height;
  };
  for (const auto& e : {Expected{{{"kind", "box"}, {"width_mm", 10}, {"length_mm", 40}, {"height_mm", 6}, {"edge_radius_mm", 0.5}}, 5, 20, 6},
                        Expected{{{"kind", "cylinder"}, {"radius_mm", 2.5}, {"length_mm", 20}, {"edge_radius_mm", 0.25}}, 10, 2.5, 5},
                        Expected{{{"kind", "plane"}}, 50, 50, 5}}) {
    Tool tool{{}, -1, 0, tip, axis, across};
    ASSERT_TRUE(shape_tool(e.json, 100, tool));
    const ToolSurface shell = tool_surface(tool);
    const auto u = reach(shell.points, tip, across), v = reach(shell.points, tip, third), w = reach(shell.points, tip, axis);
    EXPECT_NEAR(u[0], -e.across, 2e-3);
    EXPECT_NEAR(u[1], e.across, 2e-3);
    EXPECT_NEAR(v[0], -e.third, 2e-3);
    EXPECT_NEAR(v[1], e.third, 2e-3);
    EXPECT_NEAR(w[0], -e.height, 2e-3);
    EXPECT_NEAR(w[1], 0, 1e-12);
    double volume = 0;  // outward triangles enclose it
    for (const auto& t : shell.triangles)
      volume += dot(shell.points[t[0]] - tip, cross(shell.points[t[1]] - tip, shell.points[t[2]] - tip)) / 6;
    EXPECT_GT(volume, 0.7 * 4 * e.across * e.third * e.height);
    EXPECT_LE(volume, 4 * e.across * e.third * e.height * (1 + 1e-9));
    const auto cut = reach(tool_section(tool, across), tip, across);
    EXPECT_NEAR(cut[1] - cut[0], 2 * e.across, 4e-3);
  }
}

TEST(ToolShape, AnUnknownKindIsNotDrawn) {
  Tool tool;
  EXPECT_FALSE(shape_tool({{"kind", "surface"}, {"edge_radius_mm", 0.25}}, 100, tool));
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
