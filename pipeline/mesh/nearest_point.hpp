// The point of a triangle surface nearest to any point, by a uniform grid of cells.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

struct NearestPoint {
  Vec3 point{};
  int triangle = -1;
  double distance = 0;  ///< mm
};

/// The point of a triangle nearest to x (Ericson 2005, 5.1.5).
Vec3 nearest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Keeps a copy of the surface. Ties go to the triangle with the smallest index.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(Surface surface);
  NearestPoint nearest(const Vec3& x) const;
  const Surface& surface() const { return surface_; }

 private:
  std::array<int, 3> cell_of(const Vec3& x) const;
  int number(const std::array<int, 3>& cell) const { return (cell[2] * size_[1] + cell[1]) * size_[0] + cell[0]; }
  void look_into(int cell, const Vec3& x, NearestPoint& best) const;

  Surface surface_;
  Vec3 low_{};
  double cell_mm_ = 1;
  std::array<int, 3> size_{1, 1, 1};
  std::vector<int> start_, members_;  ///< triangles of cell i: members_[start_[i] … start_[i + 1])
};

}  // namespace palpate
