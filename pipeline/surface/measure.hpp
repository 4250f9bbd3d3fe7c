// What a triangle surface is: volume, area, angles, and whether it is closed, manifold and oriented.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

/// V = Σ x₀·(x₁×x₂)/6, positive when triangles are counter-clockwise from outside. Taken about the first point: exact far from
/// the origin.
double volume_mm3(const Surface& surface);
double area_mm2(const Surface& surface);

/// Angles of all triangles.
struct Angles {
  double min_deg = 180, max_deg = 0;
  int sharpest_triangle = -1;  ///< of min_deg
  double min_fold_deg = 180;   ///< smallest angle between neighbouring triangles: 180 is flat, 0 folded back
  int fold_triangle = -1;
};
Angles angles(const Surface& surface);

/// Triangles with an angle below `deg`, and pairs folded to less than `fold_deg`.
std::vector<int> poor_triangles(const Surface& surface, double deg, double fold_deg);

/// One connected piece of triangles.
struct Shell {
  std::vector<int> triangles;
  double volume_mm3 = 0, area_mm2 = 0;
  int genus = 0;  ///< 2 − 2g = V − E + F; meaningful on a closed manifold
};
/// Pieces joined over edges, the largest volume first.
std::vector<Shell> shells(const Surface& surface);

/// The kept triangles with the points they use, both in their old order.
Surface part_of(const Surface& surface, const std::vector<bool>& kept_triangles);

/// Combinatorial faults; -1 or empty: none.
struct Faults {
  int open_edges = 0, crowded_edges = 0, twisted_edges = 0,
      pinched_points = 0;                                    ///< one, more than two, same-way triangles; several fans
  Vec3 open_at{}, crowded_at{}, twisted_at{}, pinched_at{};  ///< the first of each
};
Faults faults(const Surface& surface);

/// "triangle 12 at (1.0, 2.0, 3.0) mm"
std::string place_of_triangle(const Surface& surface, int triangle);
/// "(1.0, 2.0, 3.0) mm"
std::string place_text(const Vec3& point_mm);

}  // namespace palpate
