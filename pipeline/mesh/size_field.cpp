// The estimate is for refusing absurd meshes before memory runs out; within a factor of two of what gmsh makes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/size_field.hpp>

#include <numbers>
#include <sstream>

#include <palpate/errors.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/nearest_point.hpp>

namespace palpate {
namespace {

/// Mean volume of a tetrahedron of gmsh's meshes, against the regular one's h³/(6√2): 1.7 to 1.9 measured on balls and beans.
double tet_volume(double h) { return 1.8 * h * h * h / (6 * std::numbers::sqrt2); }

std::string millimetres(double length) {
  std::ostringstream out;
  out.precision(4);
  out << length << " mm";
  return out.str();
}

double diagonal_of(const Surface& surface) {
  Vec3 low = surface.points.front(), high = low;
  for (const Vec3& p : surface.points)
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], p[a]);
      high[a] = std::max(high[a], p[a]);
    }
  return norm(high - low);
}

}  // namespace

double estimate_tets(const SizeField& field, double volume_mm3) {
  double count = 0, left = volume_mm3;
  const int shells = 200;
  const double reach = field.focus_radius + field.grading;
  for (int i = 0; i < shells && !field.focus.empty() && left > 0; ++i) {
    const double inner = reach * i / shells, outer = reach * (i + 1) / shells;
    const double half_ball = 2.0 / 3 * std::numbers::pi * (outer * outer * outer - inner * inner * inner);
    const double taken = std::min(left, half_ball * field.focus.size());
    count += taken / tet_volume(field.at_distance((inner + outer) / 2));
    left -= taken;
  }
  return count + left / tet_volume(field.edge);
}

double mean_edge(const Surface& surface) {
  double sum = 0;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) sum += norm(surface.points[t[k]] - surface.points[t[(k + 1) % 3]]);
  return sum / (3.0 * surface.triangles.size());
}

void refuse_absurd(const SizeField& field, const Surface& surface, double volume_mm3, double max_tets) {
  const double diagonal = diagonal_of(surface);
  if (std::max(field.edge, field.focus_edge) > diagonal / 2)
    throw Failure(ExitCode::misuse, "the edge length " + millimetres(std::max(field.edge, field.focus_edge)) + " is too long for this surface",
                  "the surface's bounding box has a diagonal of " + millimetres(diagonal), "--edge below " + millimetres(diagonal / 10));
  const SurfaceIndex index(surface);
  for (const Vec3& focus : field.focus) {
    const NearestPoint nearest = index.nearest(focus);
    if (nearest.distance > diagonal / 10)
      throw Failure(ExitCode::misuse, "the focus " + place_text(focus) + " is " + millimetres(nearest.distance) + " away from the surface",
                    "the nearest point of the surface is " + place_text(nearest.point), "a focus on the organ, in mm, patient LPS");
  }
  const double tets = estimate_tets(field, volume_mm3);
  if (!(tets <= max_tets)) {
    std::ostringstream what;
    what << "about " << std::round(tets / 1e5) / 10 << " million tetrahedra are to be expected, more than " << max_tets / 1e6 << " million";
    throw Failure(ExitCode::refused, what.str(), "", "a longer --edge or --focus-edge, a smaller --focus-radius, or a higher --max-tets");
  }
}

}  // namespace palpate
