// Voxels that belong to something: 1 inside, 0 outside.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

#include <palpate/volume.hpp>

namespace palpate {

using Mask = Volume<std::uint8_t>;

/// Index (i, j, k) of a voxel.
using VoxelIndex = std::array<int, 3>;

/// Smallest block of voxels, both ends included. Empty while `last` is before `first`.
struct Block {
  VoxelIndex first{0, 0, 0}, last{-1, -1, -1};
  bool empty() const { return last[0] < first[0] || last[1] < first[1] || last[2] < first[2]; }
};

/// Number of voxels inside.
std::size_t count_inside(const Mask& mask);

/// The smallest block that holds all voxels inside.
Block bounding_block(const Mask& mask);

/// `visit(neighbour index into voxels)` for the up to six voxels that share a face with voxel `at`.
template <class Visit>
void for_each_face_neighbour(const Grid& grid, std::size_t at, Visit&& visit) {
  const std::size_t row = grid.size[0], slice = row * grid.size[1];
  const std::size_t i = at % row, j = at / row % grid.size[1], k = at / slice;
  if (i > 0) visit(at - 1);
  if (i + 1 < row) visit(at + 1);
  if (j > 0) visit(at - row);
  if (j + 1 < std::size_t(grid.size[1])) visit(at + row);
  if (k > 0) visit(at - slice);
  if (k + 1 < std::size_t(grid.size[2])) visit(at + slice);
}

}  // namespace palpate
