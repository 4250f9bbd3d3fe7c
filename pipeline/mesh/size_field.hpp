// Wanted edge length in space: h(x) = fine within a radius of a focus, then growing linearly to the edge elsewhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include <palpate/mesh_files.hpp>
#include <palpate/vec3.hpp>

namespace palpate {

/// All lengths in mm. Without focus points the field is `edge` everywhere.
struct SizeField {
  double edge = 1;
  std::vector<Vec3> focus;  ///< where a tool will touch
  double focus_edge = 1;    ///< edge length within `focus_radius` of a focus
  double focus_radius = 0;
  double grading = 1;  ///< distance beyond the radius over which the length grows from focus_edge to edge

  /// `distance` to the nearest focus; infinite when there is none.
  double at_distance(double distance) const {
    if (distance <= focus_radius) return focus_edge;
    if (distance >= focus_radius + grading) return edge;
    return focus_edge + (distance - focus_radius) / grading * (edge - focus_edge);
  }
  double at(const Vec3& x) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& f : focus) nearest = std::min(nearest, norm(x - f));
    return at_distance(nearest);
  }
};

/// How many tetrahedra a volume [mm³] will take: ∫ dV / (1.8 h³ / 6√2), with half a ball around each focus, which lies on the
/// surface.
double estimate_tets(const SizeField& field, double volume_mm3);

double mean_edge(const Surface& surface);

/// Throws Failure(misuse) for an edge longer than half the surface, or a focus farther from it than a tenth of its size (with the
/// distance and the nearest point); Failure(refused) with the estimate when more than `max_tets` are to be expected.
void refuse_absurd(const SizeField& field, const Surface& surface, double volume_mm3, double max_tets);

}  // namespace palpate
