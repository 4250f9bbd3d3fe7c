// A cut parts what it should: components, area of the lips, volumes of the pieces, no inverted tetrahedron, the rim of an open cut joined.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include <palpate/errors.hpp>
#include <pipeline/mesh/boundary.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/cut.hpp>
#include <pipeline/mesh/fill.hpp>
#include <pipeline/mesh/quality.hpp>
#include <tests/mesh/shapes.hpp>

using namespace palpate;

namespace {

constexpr double radius = 10;

TetMesh ball() {
  const Surface surface = shapes::ball({0, 0, 0}, radius, 3);
  SizeField sizes;
  sizes.edge = sizes.focus_edge = mean_edge(surface);
  const auto shells = closed_shells(surface);
  TetMesh mesh = fill(surface, shells, bodies_of(surface, shells), sizes).mesh;
  name_boundary(mesh, surface);
  return mesh;
}

/// Two triangles in the plane z = 0.1 x + height, x from −20 to `end`.
Surface sheet(double height, double end) {
  Surface s;
  for (const auto& [x, y] : {std::pair{-20.0, -20.0}, std::pair{end, -20.0}, std::pair{end, 20.0}, std::pair{-20.0, 20.0}}) s.points.push_back({x, y, 0.1 * x + height});
  s.triangles = {{0, 1, 2}, {0, 2, 3}};
  s.triangle_region = {1, 1};
  return s;
}

struct Cut {
  TetMesh before = ball();
  CarriedMesh::Result result;
  CutReport report;
  explicit Cut(const Surface& surface) : report(cut(CarriedMesh(before, before.points), surface, result)) {}

  long lip_faces(const std::string& name) const {
    long count = 0;
    for (int region : result.mesh.face_region) count += result.mesh.region_names.at(region) == name;
    return count;
  }
  /// What must hold for any cut.
  void expect_sound() const {
    const MeshAudit old_audit = audit(before), a = audit(result.mesh);
    EXPECT_EQ(a.inverted_tets + a.unlisted_faces + a.open_edges + a.unused_nodes + a.unnamed_regions, 0);
    EXPECT_NEAR(a.volume_mm3, old_audit.volume_mm3, 1e-12 * old_audit.volume_mm3);
    EXPECT_NEAR(a.area_mm2, old_audit.area_mm2 + 2 * report.area_mm2, 1e-12 * a.area_mm2);
    EXPECT_EQ(lip_faces("cut_1"), report.faces);
    EXPECT_EQ(lip_faces("cut_2"), report.faces);
    for (std::size_t n = 0; n < result.rest.size(); ++n) EXPECT_LE(norm(result.rest[n] - result.mesh.points[n]), 1e-12);
  }
};

}  // namespace

TEST(Cut, APlaneMakesTwoPieces) {
  const Cut cut(sheet(1.3, 20));
  cut.expect_sound();
  EXPECT_EQ(cut.report.components, 2);
  const double height = 1.3 / std::sqrt(1.01), area = std::numbers::pi * (radius * radius - height * height);
  EXPECT_NEAR(cut.report.area_mm2, area, 0.03 * area);  // a polygon, and up to a tenth of an edge off the plane
  std::set<int> first, second;  // no node is on both lips
  double below = 0;
  for (std::size_t f = 0; f < cut.result.mesh.faces.size(); ++f) {
    const auto& name = cut.result.mesh.region_names.at(cut.result.mesh.face_region[f]);
    if (name == "cut_1") first.insert(cut.result.mesh.faces[f].begin(), cut.result.mesh.faces[f].end());
    if (name == "cut_2") second.insert(cut.result.mesh.faces[f].begin(), cut.result.mesh.faces[f].end());
  }
  for (int node : first) EXPECT_FALSE(second.contains(node));
  for (std::size_t t = 0; t < cut.result.mesh.tets.size(); ++t) {
    const Corners x = corners_of(cut.result.mesh, int(t));
    const Vec3 c = centroid(x);
    if (c[2] < 0.1 * c[0] + 1.3) below += jacobian(x) / 6;
  }
  const double cap = radius - height, above = std::numbers::pi * cap * cap * (3 * radius - cap) / 3;
  EXPECT_NEAR(audit(cut.result.mesh).volume_mm3 - below, above, 0.03 * above);
}

TEST(Cut, AnOpenSurfaceLeavesItsRimJoined) {
  const Cut cut(sheet(0.4, 0.7));
  cut.expect_sound();
  EXPECT_EQ(cut.report.components, 1);
  EXPECT_GT(cut.report.area_mm2, 0.3 * std::numbers::pi * radius * radius);
  EXPECT_LT(cut.report.area_mm2, 0.6 * std::numbers::pi * radius * radius);
}

TEST(Cut, AClosedSurfaceCutsItsInsideOut) {
  const Cut cut(shapes::ball({1, 0, 0.5}, 6, 3));
  cut.expect_sound();
  EXPECT_EQ(cut.report.components, 2);
  EXPECT_NEAR(cut.report.area_mm2, 4 * std::numbers::pi * 36, 0.08 * 4 * std::numbers::pi * 36);
}

TEST(Cut, ASurfaceBesideTheMeshIsRefused) {
  EXPECT_THROW(Cut(sheet(50, 20)), Failure);
}
