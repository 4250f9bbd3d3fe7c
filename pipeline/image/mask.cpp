// Counting and bounding voxels that belong to something.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/mask.hpp>

#include <algorithm>

namespace palpate {

std::size_t count_inside(const Mask& mask) {
  return std::count_if(mask.voxels.begin(), mask.voxels.end(), [](std::uint8_t v) { return v != 0; });
}

Block bounding_block(const Mask& mask) {
  const auto& n = mask.grid.size;
  Block block{{n[0], n[1], n[2]}, {-1, -1, -1}};
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        if (!mask(i, j, k)) continue;
        const VoxelIndex at{i, j, k};
        for (int a = 0; a < 3; ++a) {
          block.first[a] = std::min(block.first[a], at[a]);
          block.last[a] = std::max(block.last[a], at[a]);
        }
      }
  return block;
}

}  // namespace palpate
