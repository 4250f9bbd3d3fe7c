// The estimate is for refusing absurd meshes before memory runs out; within a factor of two of what gmsh makes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/size_field.hpp>

#include <numbers>

namespace palpate {
namespace {

/// Mean volume of a tetrahedron in a Delaunay mesh of edge length h, seen against the regular one's h³/(6√2).
double tet_volume(double h) { return h * h * h / (6 * std::numbers::sqrt2); }

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

}  // namespace palpate
