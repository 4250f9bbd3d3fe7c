// Pieces of a mask that hang together by faces: keeping some, dropping some, filling what they enclose.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <pipeline/image/mask.hpp>

namespace palpate {

/// Connected pieces (six neighbours: voxels that share a face), numbered from 1 in order of their first voxel.
struct Components {
  Volume<int> piece;                ///< 0 outside
  std::vector<std::size_t> voxels;  ///< [n] = voxels of piece n + 1
};

Components components_of(const Mask& mask);

/// The largest piece; of two equal ones the first. An empty mask stays empty.
Mask largest_piece(const Mask& mask);

/// The pieces that hold at least one of `seeds` (indices into the scan).
Mask pieces_with(const Mask& mask, const std::vector<VoxelIndex>& seeds);

/// The pieces of at least `voxels` voxels.
Mask pieces_of_at_least(const Mask& mask, std::size_t voxels);

/// The mask with everything filled that cannot reach the scan's border through faces of voxels outside.
Mask holes_filled(const Mask& mask);

/// The voxels that `passes(index into voxels)` and that hang together with a seed through voxels that pass.
template <class Passes>
Mask flooded(const Grid& grid, const std::vector<VoxelIndex>& seeds, Passes&& passes) {
  Mask mask{grid, std::vector<std::uint8_t>(grid.count(), 0)};
  std::vector<std::size_t> front;
  const auto enter = [&](std::size_t p) {
    if (mask.voxels[p] || !passes(p)) return;
    mask.voxels[p] = 1;
    front.push_back(p);
  };
  for (const auto& seed : seeds) enter(grid.at(seed[0], seed[1], seed[2]));
  while (!front.empty()) {
    const std::size_t p = front.back();
    front.pop_back();
    for_each_face_neighbour(grid, p, enter);
  }
  return mask;
}

}  // namespace palpate
