// Shape of shell triangles in the measures of the colon paper: edge, skew, equiangular skew, Jacobian.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/json.hpp>
#include <palpate/mesh_files.hpp>

namespace palpate {

struct TriangleShape {
  double longest_edge = 0, shortest_edge = 0;  ///< mm
  double skew_deg = 0;         ///< 90° minus the smallest angle between a median and the line through the mid-points of the two other sides
  double equiangular_skew = 0; ///< max((θmax − 60)/120, (60 − θmin)/60): 0 equilateral, 1 flat
  double jacobian = 1;         ///< smallest over largest determinant of the map from the parent triangle: 1 for every straight triangle
};
TriangleShape triangle_shape(const Vec3& a, const Vec3& b, const Vec3& c);

struct ShellQuality {
  TriangleShape worst;          ///< each measure's worst
  std::vector<int> worst_ten;   ///< triangles with the largest equiangular skew
  double area_mm2 = 0;
  double mean_edge = 0;
};
ShellQuality shell_quality(const ShellMesh& mesh);

/// The measures, and the ten worst with their places in mm.
Json to_json(const ShellMesh& mesh, const ShellQuality& quality);

}  // namespace palpate
