// Self-intersections by CGAL: boxes first, then exact triangle against triangle.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <stdexcept>

#include <pipeline/surface/cgal_mesh.hpp>
#include <pipeline/surface/remesh.hpp>

namespace palpate {

std::vector<std::pair<int, int>> self_intersections(const Surface& surface) {
  const auto mesh = to_cgal(surface);
  if (!mesh) throw std::logic_error("self_intersections: the surface is not an oriented manifold");
  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> faces;
  CGAL::Polygon_mesh_processing::self_intersections(*mesh, std::back_inserter(faces));
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [a, b] : faces) pairs.emplace_back(std::min<int>(a, b), std::max<int>(a, b));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace palpate
