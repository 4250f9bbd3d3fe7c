// Label volumes of shapes with known volume, on lattices of any spacing.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <functional>

#include <palpate/volume.hpp>

namespace palpate::test {

/// Labels 1 where inside(x) at the voxel's centre, in a box of ±half_mm around the origin. `left_handed` turns the first axis
/// round.
inline Labels labels_of(const Vec3& half_mm, const Vec3& spacing, const std::function<bool(const Vec3&)>& inside,
                        bool left_handed = false) {
  Labels labels;
  Affine& map = labels.grid.lps_from_voxel;
  for (int a = 0; a < 3; ++a) {
    labels.grid.size[a] = 2 * int(std::ceil(half_mm[a] / spacing[a])) + 1;
    const double step = a == 0 && left_handed ? -spacing[a] : spacing[a];
    map.columns[a] = {0, 0, 0};
    map.columns[a][a] = step;
    map.origin[a] = -(labels.grid.size[a] / 2) * step + 0.13 * step;  // off the symmetric place
  }
  labels.voxels.assign(labels.grid.count(), 0);
  for (int k = 0; k < labels.grid.size[2]; ++k)
    for (int j = 0; j < labels.grid.size[1]; ++j)
      for (int i = 0; i < labels.grid.size[0]; ++i) labels(i, j, k) = inside(map({double(i), double(j), double(k)}));
  return labels;
}

inline std::function<bool(const Vec3&)> ball(double radius, Vec3 centre = {0, 0, 0}) {
  return [=](const Vec3& x) { return norm(x - centre) < radius; };
}

/// Ring of radius `big` around the z axis, `small` thick.
inline std::function<bool(const Vec3&)> torus(double big, double small) {
  return [=](const Vec3& x) { return std::hypot(std::hypot(x[0], x[1]) - big, x[2]) < small; };
}

}  // namespace palpate::test
