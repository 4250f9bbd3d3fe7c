// How well labels match the truth: Dice D = 2|A ∩ B| / (|A| + |B|), volume ratio, distance of borders. For shell tests.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <exception>

#include <palpate/nifti.hpp>
#include <pipeline/image/distance.hpp>
#include <pipeline/image/mask.hpp>

namespace {

using namespace palpate;

/// `labels` read at the voxel centres of `grid`, by patient position; another orientation of the same lattice is exact.
Mask resampled(const Labels& labels, const Grid& grid) {
  const Affine voxel_from_lps = labels.grid.lps_from_voxel.inverse();
  Mask mask{grid, std::vector<std::uint8_t>(grid.count(), 0)};
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i) {
        const Vec3 v = voxel_from_lps(grid.lps_from_voxel({double(i), double(j), double(k)}));
        VoxelIndex n;
        bool inside = true;
        for (int a = 0; a < 3; ++a) {
          n[a] = static_cast<int>(std::lround(v[a]));
          inside = inside && n[a] >= 0 && n[a] < labels.grid.size[a];
        }
        mask(i, j, k) = inside && labels(n[0], n[1], n[2]) != 0;
      }
  return mask;
}

/// Voxels inside with a face neighbour outside.
Mask border_of(const Mask& mask) {
  Mask border{mask.grid, std::vector<std::uint8_t>(mask.voxels.size(), 0)};
  for (std::size_t p = 0; p < mask.voxels.size(); ++p)
    if (mask.voxels[p]) for_each_face_neighbour(mask.grid, p, [&](std::size_t q) { border.voxels[p] |= !mask.voxels[q]; });
  return border;
}

double mean_distance(const Mask& from, const Mask& to) {
  const auto d2 = squared_distance_mm2(to);
  double sum = 0, count = 0;
  for (std::size_t p = 0; p < d2.size(); ++p)
    if (from.voxels[p]) sum += std::sqrt(d2[p]), ++count;
  return sum / count;
}

}  // namespace

/// test-overlap labels truth: prints "dice volume_ratio border_distance_mm".
int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  const Labels labels = read_labels(argv[1]), truth = read_labels(argv[2]);
  const Mask a = resampled(labels, truth.grid), b = resampled(truth, truth.grid);
  double both = 0;
  for (std::size_t p = 0; p < a.voxels.size(); ++p) both += a.voxels[p] && b.voxels[p];
  const double in_a = count_inside(a), in_b = count_inside(b);
  const Mask border_a = border_of(a), border_b = border_of(b);
  std::printf("%.5f %.5f %.4f\n", 2 * both / (in_a + in_b), in_a / in_b,
              0.5 * (mean_distance(border_a, border_b) + mean_distance(border_b, border_a)));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "test-overlap: %s\n", error.what());
  return 1;
}
