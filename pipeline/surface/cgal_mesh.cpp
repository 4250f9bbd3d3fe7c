// Conversion between Surface and CGAL's halfedge mesh.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/cgal_mesh.hpp>

namespace palpate {

std::optional<CgalMesh> to_cgal(const Surface& surface) {
  CgalMesh mesh;
  mesh.reserve(surface.points.size(), 3 * surface.triangles.size() / 2, surface.triangles.size());
  for (const Vec3& p : surface.points) mesh.add_vertex({p[0], p[1], p[2]});
  using Vertex = CgalMesh::Vertex_index;
  for (const auto& t : surface.triangles)
    if (mesh.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == CgalMesh::null_face()) return std::nullopt;
  return mesh;
}

Surface from_cgal(CgalMesh& mesh) {
  mesh.collect_garbage();
  Surface surface;
  std::vector<int> index(mesh.num_vertices(), -1);
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    index[v] = int(surface.points.size());
    surface.points.push_back(vec3(mesh.point(v)));
  }
  for (const auto f : mesh.faces()) {
    std::array<int, 3> triangle{};
    int corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) triangle[corner++] = index[v];
    surface.triangles.push_back(triangle);
  }
  surface.triangle_region.assign(surface.triangles.size(), 0);
  return surface;
}

}  // namespace palpate
