// Shape of tetrahedra: dihedral angles, radius ratio 3r/R, scaled Jacobian; each 1 (or 70.53°) for the regular one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <palpate/json.hpp>
#include <palpate/mesh_files.hpp>

namespace palpate {

using Corners = std::array<Vec3, 4>;  ///< of a tetrahedron, VTK order: positive volume

Corners corners_of(const TetMesh& mesh, int tet);

Vec3 centroid(const Corners& x);

/// 6 V = a·(b×c), positive in VTK order.
double jacobian(const Corners& x);

/// The six angles between faces in degrees, at edges 01 02 03 12 13 23.
std::array<double, 6> dihedral_degrees(const Corners& x);

/// Sine of the dihedral angle nearest to 0° or 180°, negative when the tetrahedron is turned inside out: what improvement raises.
double smallest_dihedral_sine(const Corners& x);

/// 3 × inradius / circumradius: 1 regular, 0 flat.
double radius_ratio(const Corners& x);

/// √2 · 6V / largest product of the three edges at a corner (Knupp 2001): 1 regular, 0 flat, negative inverted.
double scaled_jacobian(const Corners& x);

/// min, 1 %, median of a measure.
struct Spread {
  double min = 0, one_percent = 0, median = 0;
};
Spread spread_of(std::vector<double> values);

struct QualityTable {
  Spread smallest_dihedral_deg, radius_ratio, scaled_jacobian;
  double largest_dihedral_deg = 0;
  double smallest_jacobian_mm3 = 0;
  std::array<long, 18> dihedral_histogram{};  ///< all six angles of every tetrahedron, bins of 10°
  int worst_tet = 0;                          ///< with the smallest dihedral angle
};
QualityTable quality_of(const TetMesh& mesh);

Json to_json(const QualityTable& table);

}  // namespace palpate
