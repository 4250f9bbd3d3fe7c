// Distances by CGAL's tree of boxes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/distance.hpp>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <pipeline/surface/cgal_mesh.hpp>

namespace palpate {

Distance distance(const Surface& from, const Surface& to) {
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
  const auto point = [](const Vec3& x) { return Kernel::Point_3(x[0], x[1], x[2]); };
  Triangles triangles;
  for (const auto& t : to.triangles) triangles.emplace_back(point(to.points[t[0]]), point(to.points[t[1]]), point(to.points[t[2]]));
  const CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(triangles.begin(), triangles.end());
  Distance result;
  double area = 0;
  for (const auto& t : from.triangles) {
    const Vec3 &a = from.points[t[0]], &b = from.points[t[1]], &c = from.points[t[2]];
    const Vec3 centre = (1.0 / 3) * (a + b + c);
    const double away = std::sqrt(tree.squared_distance(point(centre))), weight = norm(cross(b - a, c - a));
    result.mean_mm += away * weight;
    area += weight;
    if (away > result.largest_mm) result.largest_mm = away, result.largest_at = centre;
  }
  result.mean_mm /= area;
  return result;
}

}  // namespace palpate
