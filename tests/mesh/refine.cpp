// Bisection keeps volumes, surfaces, regions and places; every node is where its weights say, also at rest.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>

#include <pipeline/mesh/boundary.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/fill.hpp>
#include <pipeline/mesh/quality.hpp>
#include <pipeline/mesh/refine.hpp>
#include <tests/mesh/shapes.hpp>

using namespace palpate;

namespace {

/// A ball with a stone in it.
TetMesh body() {
  Surface surface = shapes::ball({0, 0, 0}, 10, 2);
  shapes::append(surface, shapes::ball({2, 0, 0}, 5, 2, 2, "stone"));
  SizeField sizes;
  sizes.edge = sizes.focus_edge = mean_edge(surface);
  const auto shells = closed_shells(surface);
  TetMesh mesh = fill(surface, shells, bodies_of(surface, shells), sizes).mesh;
  name_boundary(mesh, surface);
  return mesh;
}

/// As if pressed: half as high, wider.
Vec3 pressed(const Vec3& x) { return {std::sqrt(2.0) * x[0], std::sqrt(2.0) * x[1] + 0.1 * x[2], 0.5 * x[2]}; }

std::map<int, double> volumes(const TetMesh& mesh) {
  std::map<int, double> sums;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) sums[mesh.tet_region[t]] += jacobian(corners_of(mesh, int(t))) / 6;
  return sums;
}

struct Refined {
  TetMesh rest = body(), now = rest;
  std::vector<double> target;
  CarriedMesh::Result result;
  Refined() {
    for (auto& x : now.points) x = pressed(x);
    for (int t = 0; t < int(now.tets.size()); ++t) target.push_back(centroid(corners_of(now, t))[0] > 5 ? 1.5 : 0);
    CarriedMesh mesh(now, rest.points);
    refine(mesh, target);
    result = mesh.result();
  }
};

const Refined& refined() {
  static const Refined once;
  return once;
}

}  // namespace

TEST(Refine, LeavesNoHangingNodeAndNoInvertedTetrahedron) {
  const auto& r = refined().result;
  const MeshAudit a = audit(r.mesh);
  EXPECT_EQ(a.inverted_tets + a.unlisted_faces + a.open_edges + a.unused_nodes + a.duplicate_nodes + a.unnamed_regions, 0);
  TetMesh at_rest = r.mesh;
  at_rest.points = r.rest;
  EXPECT_EQ(audit(at_rest).inverted_tets, 0);
  EXPECT_GT(r.mesh.tets.size(), 2 * refined().now.tets.size());
}

TEST(Refine, KeepsTheVolumeOfEveryRegionNowAndAtRest) {
  const auto& r = refined();
  TetMesh at_rest = r.result.mesh;
  at_rest.points = r.result.rest;
  for (const auto& [before, after] : {std::pair{r.now, r.result.mesh}, std::pair{r.rest, at_rest}}) {
    const auto old_volumes = volumes(before), new_volumes = volumes(after);
    ASSERT_EQ(old_volumes.size(), new_volumes.size());
    for (const auto& [region, volume] : old_volumes) EXPECT_NEAR(new_volumes.at(region), volume, 1e-12 * volume);
    EXPECT_NEAR(audit(after).area_mm2, audit(before).area_mm2, 1e-12 * audit(before).area_mm2);
  }
}

TEST(Refine, ReachesTheTargetWhereMarked) {
  const auto& r = refined();
  for (std::size_t t = 0; t < r.result.mesh.tets.size(); ++t) {
    const double target = r.target[r.result.tet_parents[t]];
    const auto& corners = r.result.mesh.tets[t];
    for (int i = 0; i < 4 && target > 0; ++i)
      for (int j = 0; j < i; ++j) EXPECT_LE(norm(r.result.mesh.points[corners[i]] - r.result.mesh.points[corners[j]]), target);
  }
}

TEST(Refine, NodesAndCellsKnowWhereTheyComeFrom) {
  const auto& r = refined();
  for (std::size_t n = 0; n < r.result.origins.size(); ++n) {
    Vec3 now{}, rest{};
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const double w = r.result.origins[n].weights[i];
      EXPECT_GE(w, 0);
      sum += w;
      now = now + w * r.now.points[r.result.origins[n].nodes[i]];
      rest = rest + w * r.rest.points[r.result.origins[n].nodes[i]];
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_LE(norm(now - r.result.mesh.points[n]), 1e-12);
    EXPECT_LE(norm(rest - r.result.rest[n]), 1e-12);
  }
  std::map<int, double> share;
  for (std::size_t t = 0; t < r.result.mesh.tets.size(); ++t) {
    EXPECT_EQ(r.result.mesh.tet_region[t], r.now.tet_region[r.result.tet_parents[t]]);
    share[r.result.tet_parents[t]] += jacobian(corners_of(r.result.mesh, int(t)));
  }
  for (const auto& [parent, volume] : share) EXPECT_NEAR(volume, jacobian(corners_of(r.now, parent)), 1e-12 * volume);
  for (std::size_t f = 0; f < r.result.mesh.faces.size(); ++f) EXPECT_EQ(r.result.mesh.face_region[f], r.now.face_region[r.result.face_parents[f]]);
}

TEST(Refine, ShapesStayNearlyAsGood) {
  const auto& r = refined();
  EXPECT_GE(quality_of(r.result.mesh).scaled_jacobian.min, 0.2 * quality_of(r.now).scaled_jacobian.min);
}
