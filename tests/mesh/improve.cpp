// Improvement lifts the worst tetrahedron, keeps the boundary and the volume, and is repeatable.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <pipeline/mesh/boundary.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/fill.hpp>
#include <pipeline/mesh/improve.hpp>
#include <pipeline/mesh/quality.hpp>
#include <pipeline/mesh/tet_complex.hpp>
#include <tests/mesh/shapes.hpp>

using namespace palpate;

namespace {
const Surface torus = shapes::torus(20, 6, 40, 12);  // its sides make gmsh leave slivers

TetMesh filled(const Surface& surface) {
  SizeField sizes;
  sizes.edge = sizes.focus_edge = mean_edge(surface);
  const auto shells = closed_shells(surface);
  return fill(surface, shells, bodies_of(surface, shells), sizes).mesh;
}

/// Two tetrahedra on a flat kite, whose shared face makes both flat: the edge between the apexes is better.
TetMesh two_flat() {
  TetMesh mesh;
  mesh.points = {{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {0, 0, 0.9}, {0, 0, -0.9}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  mesh.tet_region = {1, 1};
  return mesh;
}
}  // namespace

TEST(TetComplex, OppositeEdgeKeepsOrientation) {
  const TetMesh mesh = two_flat();
  const Tet& t = mesh.tets[0];
  const TetComplex complex(mesh);
  for (int a : t)
    for (int b : t)
      if (a != b) {
        const auto [c, d] = opposite_edge(t, a, b);
        EXPECT_GT(complex.quality_of({a, b, c, d}), 0);
      }
  for (int corner = 0; corner < 4; ++corner) EXPECT_GT(complex.quality_of(with_apex(t, corner)), 0);
}

TEST(TetComplex, SwappedFaceFillsTheSameVolume) {
  TetMesh mesh = two_flat();
  TetComplex complex(mesh);
  const std::vector<Tet> around = {{3, 4, 0, 2}, {3, 4, 2, 1}, {3, 4, 1, 0}};
  const double sign = complex.quality_of(around[0]) > 0 ? 1 : -1;
  double volume = 0;
  for (const Tet& t : around) volume += sign * jacobian({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]}) / 6;
  EXPECT_NEAR(volume, audit(mesh).volume_mm3, 1e-12);
}

TEST(Improve, RaisesTheWorstAngleAndKeepsBoundaryAndVolume) {
  TetMesh mesh = filled(torus);
  const double before = quality_of(mesh).smallest_dihedral_deg.min, volume = audit(mesh).volume_mm3;
  auto faces = boundary_faces(mesh);
  improve(mesh, static_cast<int>(torus.points.size()), SurfaceIndex(torus));
  const QualityTable after = quality_of(mesh);
  EXPECT_GT(after.smallest_dihedral_deg.min, before);
  EXPECT_GE(after.smallest_dihedral_deg.min, 15);   // engineering: the target is 18°
  EXPECT_LE(after.largest_dihedral_deg, 165);
  EXPECT_NEAR(audit(mesh).volume_mm3, volume, 1e-3 * volume);  // engineering: surface nodes may slide along facets
  name_boundary(mesh, torus);
  const MeshAudit found = audit(mesh);
  EXPECT_EQ(found.inverted_tets + found.unlisted_faces + found.open_edges + found.unused_nodes + found.duplicate_nodes, 0);
  EXPECT_EQ(mesh.faces.size(), torus.triangles.size());
}

TEST(Improve, IsRepeatable) {
  TetMesh one = filled(torus), two = filled(torus);
  improve(one, static_cast<int>(torus.points.size()), SurfaceIndex(torus));
  improve(two, static_cast<int>(torus.points.size()), SurfaceIndex(torus));
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.tets, two.tets);
}
