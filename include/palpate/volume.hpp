// A block of voxels and where it lies in the patient; x fastest, then y, then z.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <palpate/vec3.hpp>

namespace palpate {

/// Voxel lattice. `lps_from_voxel` takes the index (i, j, k) of a voxel to its centre in mm; columns are the steps along i, j, k.
struct Grid {
  std::array<int, 3> size{0, 0, 0};
  Affine lps_from_voxel;

  std::size_t count() const { return std::size_t(size[0]) * size[1] * size[2]; }
  std::size_t at(int i, int j, int k) const { return (std::size_t(k) * size[1] + j) * size[0] + i; }
  Vec3 spacing() const {
    return {norm(lps_from_voxel.columns[0]), norm(lps_from_voxel.columns[1]), norm(lps_from_voxel.columns[2])};
  }
  double voxel_mm3() const { return std::abs(lps_from_voxel.determinant()); }
};

template <class Voxel>
struct Volume {
  Grid grid;
  std::vector<Voxel> voxels;  ///< grid.count() of them

  Voxel& operator()(int i, int j, int k) { return voxels[grid.at(i, j, k)]; }
  const Voxel& operator()(int i, int j, int k) const { return voxels[grid.at(i, j, k)]; }
};

using Scan = Volume<float>;
using Labels = Volume<std::uint16_t>;

}  // namespace palpate
