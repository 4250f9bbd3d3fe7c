// The centre line of a tube and its diameter along it: centroids of the bands between level lines of the distance along the surface.
// (Verroust & Lazarus 2000, Extracting skeletal curves from 3D scattered data, The Visual Computer 16:15.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

/// A polyline with what the tube measures around it, all mm.
struct CentreLine {
  std::vector<Vec3> points;
  std::vector<double> arc;       ///< length from the first point
  std::vector<double> diameter;  ///< of the circle with the area of the section at right angles
  double length() const { return arc.back(); }

  Vec3 at(double s) const;       ///< extended straight beyond the ends
  Vec3 tangent(double s) const;  ///< unit
  /// Arc length of the nearest point, also beyond the ends.
  double project(const Vec3& x) const;
};

/// `surface`: one piece, open at both ends or closed. `step`: distance between points, mm. Throws Failure(check_failed) when it is no
/// longer than it is wide.
CentreLine centre_line(const Surface& surface, double step);

/// Area enclosed where a plane cuts the piece of surface around `point`: Σ over cut edges, mm²; open contours are closed straight.
double section_area(const Surface& surface, const Vec3& point, const Vec3& normal, double reach);

}  // namespace palpate
