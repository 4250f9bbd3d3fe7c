// Repair by CGAL's polygon mesh processing.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/repair.hpp>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <set>

#include <palpate/errors.hpp>
#include <pipeline/surface/cgal_mesh.hpp>
#include <pipeline/surface/distance.hpp>
#include <pipeline/surface/measure.hpp>
#include <pipeline/surface/remesh.hpp>

namespace palpate {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Halfedge = CgalMesh::Halfedge_index;

CgalMesh mesh_of_soup(const Surface& brought) {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const Vec3& x : brought.points) points.emplace_back(x[0], x[1], x[2]);
  for (const auto& t : brought.triangles) polygons.push_back({std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])});
  pmp::repair_polygon_soup(points, polygons);
  pmp::orient_polygon_soup(points, polygons);
  CgalMesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  pmp::stitch_borders(mesh);
  pmp::remove_degenerate_faces(mesh);
  pmp::duplicate_non_manifold_vertices(mesh);
  return mesh;
}

Hole hole_at(const CgalMesh& mesh, Halfedge border) {
  Hole hole;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const auto h : CGAL::halfedges_around_face(border, mesh)) {
    const Vec3 x = vec3(mesh.point(mesh.target(h)));
    for (int a = 0; a < 3; ++a) low[a] = std::min(low[a], x[a]), high[a] = std::max(high[a], x[a]);
    ++hole.edges;
  }
  hole.across_mm = norm(high - low);
  hole.centre_mm = 0.5 * (low + high);
  return hole;
}

[[noreturn]] void refuse(const Hole& hole, const std::string& why, const std::string& next) {
  char size[64];
  std::snprintf(size, sizeof size, "%d edges, %.2f mm across", hole.edges, hole.across_mm);
  throw Failure(ExitCode::check_failed, "the surface has a hole that cannot be closed: " + why + " (" + size + ")",
                "hole around " + place_text(hole.centre_mm), next);
}

void close_holes(CgalMesh& mesh, double hole_mm, RepairLedger& ledger) {
  std::vector<Halfedge> borders;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(borders));
  for (const Halfedge border : borders) {
    const Hole hole = hole_at(mesh, border);
    if (!(hole.across_mm <= hole_mm)) refuse(hole, "it is too large", "scan or model the missing part, or allow it with --hole");
    std::vector<CgalMesh::Face_index> faces;
    std::vector<CgalMesh::Vertex_index> points;
    pmp::triangulate_and_refine_hole(mesh, border, std::back_inserter(faces), std::back_inserter(points));
    if (faces.empty()) refuse(hole, "no triangles fit into it", "mend it in the program the surface comes from");
    ledger.holes.push_back(hole);
  }
}

void expect_no_crossing(const Surface& surface) {
  const auto pairs = self_intersections(surface);
  if (pairs.empty()) return;
  throw Failure(ExitCode::check_failed,
                "the mended surface crosses itself at " + std::to_string(pairs.size()) + " pairs of triangles",
                place_of_triangle(surface, pairs[0].first) + " meets " + place_of_triangle(surface, pairs[0].second),
                "mend it in the program the surface comes from, or voxelise it and start from labels");
}

}  // namespace

bool is_surface_file(const std::filesystem::path& path) {
  static const std::set<std::string> endings{".vtp", ".stl", ".ply", ".obj"};
  return endings.contains(path.extension().string());
}

Surface read_brought_surface(const std::filesystem::path& path) {
  if (path.extension() == ".vtp") return read_surface(path);
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_polygon_soup(path.string(), points, polygons) || polygons.empty())
    throw Failure(ExitCode::unreadable, "not a readable surface (damaged, truncated or another format)", path.string(),
                  "export it again as .stl or .ply");
  Surface surface;
  for (const auto& p : points) surface.points.push_back(vec3(p));
  for (const auto& polygon : polygons)
    for (std::size_t c = 2; c < polygon.size(); ++c)
      surface.triangles.push_back({int(polygon[0]), int(polygon[c - 1]), int(polygon[c])});
  for (const Vec3& x : surface.points)
    if (!std::isfinite(dot(x, x)))
      throw Failure(ExitCode::unreadable, "points that are not finite", path.string(), "export it again");
  surface.triangle_region.assign(surface.triangles.size(), 1);
  surface.region_names = {{1, "organ"}};
  return surface;
}

Surface repair(const Surface& brought, double hole_mm, RepairLedger& ledger) {
  ledger.points_in = long(brought.points.size()), ledger.triangles_in = long(brought.triangles.size());
  CgalMesh mesh = mesh_of_soup(brought);
  ledger.points_mended = long(mesh.number_of_vertices()), ledger.triangles_mended = long(mesh.number_of_faces());
  close_holes(mesh, hole_mm, ledger);
  if (mesh.number_of_faces() == 0)
    throw Failure(ExitCode::check_failed, "no triangle is left of the surface", "", "look at the file in a viewer");
  Surface surface = from_cgal(mesh);
  expect_no_crossing(surface);
  pmp::orient_to_bound_a_volume(mesh);
  surface = from_cgal(mesh);
  surface.region_names = brought.region_names;
  const auto nearest = nearest_triangles(surface, brought);
  for (std::size_t t = 0; t < nearest.size(); ++t) surface.triangle_region[t] = brought.triangle_region[nearest[t]];
  return surface;
}

}  // namespace palpate
