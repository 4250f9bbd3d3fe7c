// Tubes by numbers: round sections of one radius along a line, with flat ends; and those that fit a given surface best.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/centre_line.hpp>

namespace palpate {

/// Regions of what make_tube() writes: 1 = wall, 2 and 3 = end_1 and end_2, flat.
constexpr int wall_region = 1;

/// A closed tube around the polyline `axis` (at least two points), corners of the wall on the radius, edges about `edge` long.
Surface make_tube(const std::vector<Vec3>& axis, double radius, double edge);

struct Cylinder {
  Vec3 centre{0, 0, 0}, axis{0, 0, 1};
  double radius = 1, length = 1;
};

/// Least squares of the distance between wall and cylinder over the area of the wall (Gauss-Newton on four numbers of the axis and
/// the radius); flat ends are where the surface ends. `line`: its centre line. Throws Failure(not_converged).
Cylinder fit_cylinder(const Surface& surface, const CentreLine& line);

/// How far two closed surfaces lie apart.
struct Difference {
  double hausdorff_mm = 0;  ///< largest distance of corners and centroids, both ways
  double rms_mm = 0;        ///< over both areas
  double volume_mm3 = 0, other_volume_mm3 = 0;
  Vec3 worst_at{0, 0, 0};   ///< where the largest is
};
Difference difference(const Surface& one, const Surface& other);

}  // namespace palpate
