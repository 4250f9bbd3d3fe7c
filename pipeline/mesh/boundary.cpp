// Faces are matched by their sorted corners; everything is sorted, so that results do not depend on hashing.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/boundary.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <pipeline/mesh/nearest_point.hpp>
#include <pipeline/mesh/quality.hpp>

namespace palpate {
namespace {

using Triple = std::array<int, 3>;

Triple sorted(Triple t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// The same face starting with its smallest corner, orientation kept.
Triple rotated(Triple t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Outward faces of a tetrahedron with positive volume.
constexpr int faces_of_tet[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

long symmetric_difference_size(std::vector<Triple> a, std::vector<Triple> b) {
  for (auto* list : {&a, &b}) {
    for (auto& t : *list) t = rotated(t);
    std::sort(list->begin(), list->end());
  }
  std::vector<Triple> different;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(different));
  return static_cast<long>(different.size());
}

long odd_edges(const std::vector<Triple>& faces) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& f : faces)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(f[k], f[(k + 1) % 3])];
  return std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second % 2; });
}

}  // namespace

std::vector<Triple> boundary_faces(const TetMesh& mesh) {
  std::vector<std::pair<Triple, int>> all;  // sorted corners, 4 * tet + face
  for (int t = 0; t < mesh.tets.size(); ++t)
    for (int f = 0; f < 4; ++f) {
      const auto& [i, j, k] = faces_of_tet[f];
      all.push_back({sorted({mesh.tets[t][i], mesh.tets[t][j], mesh.tets[t][k]}), 4 * t + f});
    }
  std::sort(all.begin(), all.end());
  std::vector<int> single;
  for (std::size_t i = 0; i < all.size(); ++i)
    if ((i == 0 || all[i - 1].first != all[i].first) && (i + 1 == all.size() || all[i + 1].first != all[i].first)) single.push_back(all[i].second);
  std::sort(single.begin(), single.end());
  std::vector<Triple> faces;
  for (int code : single) {
    const auto& [i, j, k] = faces_of_tet[code % 4];
    const auto& tet = mesh.tets[code / 4];
    faces.push_back({tet[i], tet[j], tet[k]});
  }
  return faces;
}

void name_boundary(TetMesh& mesh, const Surface& surface) {
  const std::set<int> regions(mesh.tet_region.begin(), mesh.tet_region.end());
  int shift = 100;
  while (shift <= *regions.rbegin()) shift *= 10;
  const auto name_of = [&](int region) {
    const auto found = surface.region_names.find(region);
    return found == surface.region_names.end() ? "region_" + std::to_string(region) : found->second;
  };
  for (int region : regions) mesh.region_names[region] = name_of(region);
  std::map<Triple, int> region_of;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) region_of[sorted(surface.triangles[t])] = surface.triangle_region[t];
  mesh.faces = boundary_faces(mesh);
  mesh.face_region.clear();
  for (const auto& face : mesh.faces) {
    const int region = region_of.at(sorted(face));
    mesh.face_region.push_back(shift + region);
    mesh.region_names[shift + region] = name_of(region) + "_surface";
  }
}

/// A way from within a body to another's outer surface crosses the body's own, so all bodies of one region can be asked together.
void divide_by_nearest_triangle(TetMesh& mesh, const Surface& surface, const std::vector<Shell>& shells, const std::vector<Body>& bodies) {
  std::map<int, Surface> outside;  // by the bodies' region
  for (const Body& body : bodies) {
    Surface& part = outside[body.region];
    for (int t : shells[body.outer].triangles) {
      part.triangles.push_back(surface.triangles[t]);
      part.triangle_region.push_back(surface.triangle_region[t]);
    }
  }
  std::map<int, SurfaceIndex> mixed;
  for (auto& [region, part] : outside) {
    const std::set<int> found(part.triangle_region.begin(), part.triangle_region.end());
    part.points = surface.points;
    if (found.size() > 1) mixed.emplace(region, SurfaceIndex(part));
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (const auto body = mixed.find(mesh.tet_region[t]); body != mixed.end())
      mesh.tet_region[t] = body->second.surface().triangle_region[body->second.nearest(centroid(corners_of(mesh, t))).triangle];
}

MeshAudit audit(const TetMesh& mesh) {
  MeshAudit result;
  std::vector<bool> used(mesh.points.size(), false);
  std::set<int> regions(mesh.tet_region.begin(), mesh.tet_region.end());
  regions.insert(mesh.face_region.begin(), mesh.face_region.end());
  for (int t = 0; t < mesh.tets.size(); ++t) {
    const double six_volumes = jacobian(corners_of(mesh, t));
    result.volume_mm3 += six_volumes / 6;
    result.inverted_tets += !(six_volumes > 0);
    for (int i : mesh.tets[t]) used[i] = true;
  }
  const auto boundary = boundary_faces(mesh);
  for (const auto& [i, j, k] : boundary) result.area_mm2 += norm(cross(mesh.points[j] - mesh.points[i], mesh.points[k] - mesh.points[i])) / 2;
  result.unlisted_faces = symmetric_difference_size(boundary, mesh.faces);
  result.open_edges = odd_edges(boundary);
  result.unused_nodes = std::count(used.begin(), used.end(), false);
  result.duplicate_nodes = static_cast<long>(mesh.points.size() - std::set<Vec3>(mesh.points.begin(), mesh.points.end()).size());
  for (int region : regions) result.unnamed_regions += !mesh.region_names.contains(region);
  return result;
}

}  // namespace palpate
