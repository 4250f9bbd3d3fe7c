// The audit sees each fault that is planted; regions and names of a body inside another.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <pipeline/mesh/boundary.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/fill.hpp>
#include <tests/mesh/shapes.hpp>

using namespace palpate;

namespace {
TetMesh meshed(const Surface& surface) {
  SizeField sizes;
  sizes.edge = sizes.focus_edge = mean_edge(surface);
  const auto shells = closed_shells(surface);
  const auto bodies = bodies_of(surface, shells);
  TetMesh mesh = fill(surface, shells, bodies, sizes).mesh;
  divide_by_nearest_triangle(mesh, surface, shells, bodies);
  name_boundary(mesh, surface);
  return mesh;
}
const Surface ball = shapes::ball({0, 0, 0}, 10, 2);

long faults(const TetMesh& mesh) {
  const MeshAudit a = audit(mesh);
  return a.inverted_tets + a.unlisted_faces + a.open_edges + a.unused_nodes + a.duplicate_nodes + a.unnamed_regions;
}
}  // namespace

TEST(Boundary, OfAFilledBallIsTheBall) {
  const TetMesh mesh = meshed(ball);
  EXPECT_EQ(faults(mesh), 0);
  EXPECT_EQ(mesh.faces.size(), ball.triangles.size());
  EXPECT_NEAR(audit(mesh).volume_mm3, enclosed_volume(ball), 1e-9 * enclosed_volume(ball));
  EXPECT_EQ(mesh.region_names.at(1), "ball");
  EXPECT_EQ(mesh.region_names.at(101), "ball_surface");
  EXPECT_EQ(mesh.face_region.front(), 101);
}

TEST(Boundary, BodyInsideAnotherSharesItsNodes) {
  Surface surface = ball;
  shapes::append(surface, shapes::ball({1, 0, 0}, 5, 2, 2, "stone"));
  const TetMesh mesh = meshed(surface);
  EXPECT_EQ(faults(mesh), 0);
  EXPECT_EQ(mesh.faces.size(), ball.triangles.size());  // the interface is no boundary
  double stone = 0;
  TetMesh part = mesh;
  part.tets.clear();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (mesh.tet_region[t] == 2) part.tets.push_back(mesh.tets[t]);
  stone = audit(part).volume_mm3;
  EXPECT_NEAR(stone, enclosed_volume(shapes::ball({1, 0, 0}, 5, 2)), 1e-9 * stone);
}

TEST(Boundary, OrgansThatHangTogetherAreDividedByTheNearestTriangle) {
  Surface surface = ball;  // the left half is another organ
  surface.region_names[7] = "left";
  const auto centre_x = [&](std::size_t t) {
    double x = 0;
    for (int i : surface.triangles[t]) x += surface.points[i][0] / 3;
    return x;
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) surface.triangle_region[t] = centre_x(t) < 0 ? 7 : 1;
  const TetMesh mesh = meshed(surface);
  EXPECT_EQ(faults(mesh), 0);
  EXPECT_EQ(mesh.region_names.at(7), "left");
  EXPECT_EQ(mesh.region_names.at(107), "left_surface");
  TetMesh part = mesh;
  part.tets.clear();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.tet_region[t] != 7) continue;
    part.tets.push_back(mesh.tets[t]);
    Vec3 centre{};
    for (int i : mesh.tets[t]) centre = centre + 0.25 * mesh.points[i];
    EXPECT_LT(centre[0], 2.0) << "an edge";
  }
  EXPECT_NEAR(audit(part).volume_mm3, audit(mesh).volume_mm3 / 2, 0.05 * audit(mesh).volume_mm3);
}

TEST(Boundary, EachPlantedFaultIsSeen) {
  const TetMesh good = meshed(ball);
  TetMesh bad = good;
  std::swap(bad.tets[3][0], bad.tets[3][1]);
  EXPECT_EQ(audit(bad).inverted_tets, 1);

  bad = good;
  std::swap(bad.faces[5][0], bad.faces[5][1]);
  EXPECT_EQ(audit(bad).unlisted_faces, 2);  // one listed that is none, one missing

  bad = good;
  bad.faces.pop_back();
  bad.face_region.pop_back();
  EXPECT_EQ(audit(bad).unlisted_faces, 1);

  bad = good;
  bad.points.push_back({0, 0, 99});
  EXPECT_EQ(audit(bad).unused_nodes, 1);
  bad.points.back() = bad.points.front();
  EXPECT_EQ(audit(bad).duplicate_nodes, 1);

  bad = good;
  bad.region_names.erase(101);
  EXPECT_EQ(audit(bad).unnamed_regions, 1);
}
