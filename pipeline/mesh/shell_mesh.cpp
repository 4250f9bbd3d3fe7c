// gmsh's reparametrisation of a discrete surface, and what is collected from it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/shell_mesh.hpp>

#include <gmsh.h>

#include <map>
#include <numbers>

#include <palpate/errors.hpp>
#include <pipeline/mesh/gmsh_session.hpp>
#include <pipeline/mesh/open_tube.hpp>

namespace palpate {
namespace {

void add_discrete(const Surface& surface) {
  gmsh::model::addDiscreteEntity(2, 1);
  std::vector<std::size_t> nodes, triangles, corners;
  std::vector<double> coordinates;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    nodes.push_back(i + 1);
    coordinates.insert(coordinates.end(), surface.points[i].begin(), surface.points[i].end());
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    triangles.push_back(t + 1);
    for (int i : surface.triangles[t]) corners.push_back(i + 1);
  }
  gmsh::model::mesh::addNodes(2, 1, nodes, coordinates);
  gmsh::model::mesh::addElementsByType(1, 2, triangles, corners);
}

/// Nodes in order of their tag, triangles in order of theirs.
ShellMesh collect() {
  ShellMesh mesh;
  std::vector<std::size_t> tags, corners;
  std::vector<double> xyz, parametric;
  gmsh::model::mesh::getNodes(tags, xyz, parametric);
  std::map<std::size_t, Vec3> places;
  for (std::size_t n = 0; n < tags.size(); ++n) places[tags[n]] = {xyz[3 * n], xyz[3 * n + 1], xyz[3 * n + 2]};
  gmsh::vectorpair faces;
  gmsh::model::getEntities(faces, 2);
  std::vector<std::size_t> triangles;
  for (const auto& [dimension, face] : faces) {
    std::vector<std::size_t> some, their_corners;
    gmsh::model::mesh::getElementsByType(2, some, their_corners, face);
    triangles.insert(triangles.end(), some.begin(), some.end());
    corners.insert(corners.end(), their_corners.begin(), their_corners.end());
  }
  std::map<std::size_t, int> index;
  for (std::size_t tag : corners) index[tag] = 0;
  for (auto& [tag, i] : index) {
    i = static_cast<int>(mesh.points.size());
    mesh.points.push_back(places.at(tag));
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
    mesh.triangles.push_back({index[corners[3 * t]], index[corners[3 * t + 1]], index[corners[3 * t + 2]]});
  mesh.triangle_region.assign(mesh.triangles.size(), 1);
  mesh.region_names = {{1, "wall"}};
  return mesh;
}

/// gmsh may turn a piece over: triangles as the given surface has them.
void orient(ShellMesh& mesh, double volume) {
  double six = 0;
  const Vec3& o = mesh.points.front();
  for (const auto& t : mesh.triangles) six += dot(mesh.points[t[0]] - o, cross(mesh.points[t[1]] - o, mesh.points[t[2]] - o));
  if ((six < 0) == (volume < 0)) return;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

double six_volumes(const Surface& s) {
  double six = 0;
  for (const auto& t : s.triangles) six += dot(s.points[t[0]] - s.points[0], cross(s.points[t[1]] - s.points[0], s.points[t[2]] - s.points[0]));
  return six;
}

/// Each rim's area vector gives the direction of the centre line there.
void mark_ends(ShellMesh& mesh) {
  mesh.end.assign(mesh.points.size(), 0);
  mesh.end_direction.assign(mesh.points.size(), Vec3{0, 0, 0});
  int number = 0;
  for (const auto& rim : rims(mesh.triangles)) {
    ++number;
    Vec3 area{0, 0, 0}, centre{0, 0, 0};
    for (int i : rim) centre = centre + (1.0 / rim.size()) * mesh.points[i];
    for (std::size_t k = 0; k < rim.size(); ++k)
      area = area + cross(mesh.points[rim[k]] - centre, mesh.points[rim[(k + 1) % rim.size()]] - centre);
    // an outward wall runs its rims against the direction out of the tube
    for (int i : rim) mesh.end[i] = number, mesh.end_direction[i] = -1.0 * unit(area);
  }
}

}  // namespace

ShellMesh mesh_tube(const Surface& tube, const std::function<double(const Vec3&)>& size, double thickness_mm) {
  const GmshSession session;
  const auto fail = [&](const std::string& thrown) -> Failure {
    const auto errors = session.lines("Error");
    return {ExitCode::check_failed, "gmsh could not mesh the tube: " + (errors.empty() ? thrown : errors.front()), "",
            "palpate-surface with more smoothing, or cuts at places where the tube is round"};
  };
  try {
    gmsh::option::setNumber("Mesh.Algorithm", 6);  // frontal-Delaunay: the most even triangles
    add_discrete(tube);
    gmsh::model::mesh::classifySurfaces(std::numbers::pi, true, true, std::numbers::pi);
    gmsh::model::mesh::createGeometry();
    gmsh::model::geo::synchronize();  // without it gmsh 4.8 counts the new curves as not meshable and keeps the old edges
    gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double z) { return size({x, y, z}); });
    gmsh::model::mesh::generate(2);
    if (!session.lines("Error").empty()) throw fail("");
    ShellMesh mesh = collect();
    orient(mesh, six_volumes(tube));
    mark_ends(mesh);
    mesh.thickness_mm.assign(mesh.points.size(), thickness_mm);
    return mesh;
  } catch (const Failure&) {
    throw;
  } catch (const std::exception& error) {
    throw fail(error.what());
  } catch (const std::string& error) {
    throw fail(error);
  } catch (int) {
    throw fail("it gave no reason");
  }
}

}  // namespace palpate
