// Distances by CGAL's tree of boxes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/distance.hpp>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <pipeline/surface/cgal_mesh.hpp>

namespace palpate {

namespace {

using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Vec3& x) { return {x[0], x[1], x[2]}; }

Triangles triangles_of(const Surface& s) {
  Triangles triangles;
  for (const auto& t : s.triangles) triangles.emplace_back(point(s.points[t[0]]), point(s.points[t[1]]), point(s.points[t[2]]));
  return triangles;
}

Vec3 centroid(const Surface& s, const std::array<int, 3>& t) {
  return (1.0 / 3) * (s.points[t[0]] + s.points[t[1]] + s.points[t[2]]);
}

}  // namespace

Distance distance(const Surface& from, const Surface& to) {
  const Triangles triangles = triangles_of(to);
  const Tree tree(triangles.begin(), triangles.end());
  Distance result;
  double area = 0;
  for (const auto& t : from.triangles) {
    const Vec3 centre = centroid(from, t);
    const double away = std::sqrt(tree.squared_distance(point(centre)));
    const double weight = norm(cross(from.points[t[1]] - from.points[t[0]], from.points[t[2]] - from.points[t[0]]));
    result.mean_mm += away * weight;
    area += weight;
    if (away > result.largest_mm) result.largest_mm = away, result.largest_at = centre;
  }
  result.mean_mm /= area;
  return result;
}

std::vector<int> nearest_triangles(const Surface& from, const Surface& to) {
  const Triangles triangles = triangles_of(to);
  const Tree tree(triangles.begin(), triangles.end());
  std::vector<int> nearest;
  for (const auto& t : from.triangles)
    nearest.push_back(int(tree.closest_point_and_primitive(point(centroid(from, t))).second - triangles.begin()));
  return nearest;
}

}  // namespace palpate
