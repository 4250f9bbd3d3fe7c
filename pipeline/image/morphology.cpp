// Balls by exact distance: dilation is d(p, A) ≤ r, erosion is d(p, not A) > r. Cost does not depend on the radius.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/morphology.hpp>

#include <algorithm>
#include <cmath>

#include <pipeline/image/distance.hpp>

namespace palpate {
namespace {

/// Voxels on the ball's rim count as within it, whatever float rounding says.
float squared_with_rim(double radius_mm) { return static_cast<float>(radius_mm * radius_mm * (1 + 1e-5)); }

/// A part of a larger mask: its lattice, with enough empty voxels around that no ball leaves it.
struct Crop {
  Mask mask;
  VoxelIndex offset;  ///< of its first voxel in the large mask; may be negative
};

Crop crop_around(const Mask& mask, double radius_mm) {
  const Block block = bounding_block(mask);
  const Vec3 h = mask.grid.spacing();
  Crop crop;
  crop.mask.grid.lps_from_voxel.columns = mask.grid.lps_from_voxel.columns;
  for (int a = 0; a < 3; ++a) {
    const int margin = static_cast<int>(std::ceil(radius_mm / h[a] * (1 + 1e-5))) + 1;
    crop.offset[a] = block.first[a] - margin;
    crop.mask.grid.size[a] = block.last[a] - block.first[a] + 1 + 2 * margin;
  }
  crop.mask.voxels.assign(crop.mask.grid.count(), 0);
  const auto& o = crop.offset;
  for (int k = block.first[2]; k <= block.last[2]; ++k)
    for (int j = block.first[1]; j <= block.last[1]; ++j)
      for (int i = block.first[0]; i <= block.last[0]; ++i) crop.mask(i - o[0], j - o[1], k - o[2]) = mask(i, j, k);
  return crop;
}

/// The crop put back into an empty mask on `grid`; what lies beyond it is dropped.
Mask put_back(const Crop& crop, const Grid& grid) {
  Mask mask{grid, std::vector<std::uint8_t>(grid.count(), 0)};
  VoxelIndex from, to;
  for (int a = 0; a < 3; ++a) {
    from[a] = std::max(0, crop.offset[a]);
    to[a] = std::min(grid.size[a], crop.offset[a] + crop.mask.grid.size[a]);
  }
  const auto& o = crop.offset;
  for (int k = from[2]; k < to[2]; ++k)
    for (int j = from[1]; j < to[1]; ++j)
      for (int i = from[0]; i < to[0]; ++i) mask(i, j, k) = crop.mask(i - o[0], j - o[1], k - o[2]);
  return mask;
}

void dilate(Mask& mask, double radius_mm) {
  const auto d2 = squared_distance_mm2(mask);
  const float r2 = squared_with_rim(radius_mm);
  for (std::size_t p = 0; p < d2.size(); ++p) mask.voxels[p] = d2[p] <= r2;
}

void complement(Mask& mask) {
  for (auto& v : mask.voxels) v = !v;
}

void erode(Mask& mask, double radius_mm) {
  complement(mask);
  dilate(mask, radius_mm);
  complement(mask);
}

template <class Work>
Mask on_crop(const Mask& mask, double radius_mm, Work&& work) {
  if (!(radius_mm > 0) || bounding_block(mask).empty()) return mask;
  Crop crop = crop_around(mask, radius_mm);
  work(crop.mask);
  return put_back(crop, mask.grid);
}

}  // namespace

Mask dilated(const Mask& mask, double radius_mm) {
  return on_crop(mask, radius_mm, [&](Mask& m) { dilate(m, radius_mm); });
}

Mask eroded(const Mask& mask, double radius_mm) {
  return on_crop(mask, radius_mm, [&](Mask& m) { erode(m, radius_mm); });
}

Mask opened(const Mask& mask, double radius_mm) {
  return on_crop(mask, radius_mm, [&](Mask& m) {
    erode(m, radius_mm);
    dilate(m, radius_mm);
  });
}

Mask closed(const Mask& mask, double radius_mm) {
  return on_crop(mask, radius_mm, [&](Mask& m) {
    dilate(m, radius_mm);
    erode(m, radius_mm);
  });
}

}  // namespace palpate
