// Region growing: what hangs together with a seed through voxels with lower ≤ I ≤ upper (Adams & Bischof 1994, with a fixed
// criterion). Without thresholds the interval is m ± w s of the seeds' neighbourhoods, m their mean, s their standard deviation.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/segmentation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <palpate/errors.hpp>
#include <pipeline/image/components.hpp>
#include <pipeline/image/histogram.hpp>

namespace palpate::segmentation {
namespace {

/// Intensities of the voxels whose centres are within the neighbourhood of a seed; a voxel near two seeds counts twice.
std::vector<float> neighbourhood_of_seeds(const Task& task) {
  const Grid& grid = task.scan.grid;
  const Vec3 h = grid.spacing();
  std::vector<float> values;
  for (const auto& seed : task.seeds) {
    VoxelIndex first, last;
    for (int a = 0; a < 3; ++a) {
      const int reach = static_cast<int>(task.neighbourhood_mm / h[a]);
      first[a] = std::max(0, seed[a] - reach);
      last[a] = std::min(grid.size[a] - 1, seed[a] + reach);
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i)
          if (std::hypot(h[0] * (i - seed[0]), h[1] * (j - seed[1]), h[2] * (k - seed[2])) <= task.neighbourhood_mm)
            values.push_back(task.scan(i, j, k));
  }
  return values;
}

void expect_seeds_inside(const Task& task, double lower, double upper) {
  for (const auto& seed : task.seeds) {
    const float value = task.scan(seed[0], seed[1], seed[2]);
    if (value >= lower && value <= upper) continue;
    std::ostringstream what, where;
    what << "a seed lies outside the interval it should grow in: its intensity (smoothed) is " << value << ", the interval "
         << lower << " to " << upper;
    const Vec3 mm = task.scan.grid.lps_from_voxel({double(seed[0]), double(seed[1]), double(seed[2])});
    where << "voxel at " << mm[0] << "," << mm[1] << "," << mm[2] << " mm";
    throw Failure(ExitCode::misuse, what.str(), where.str(), "move the seed, or widen the interval");
  }
}

Choice choose(const Task& task) {
  if (task.seeds.empty())
    throw Failure(ExitCode::misuse, "region growing without a seed", "", "--seeds x,y,z in mm (patient LPS)");
  const Statistics near = statistics_of(neighbourhood_of_seeds(task));
  const bool automatic = !task.lower && !task.upper;
  const double half_width = automatic ? task.interval_sd * near.sd : std::numeric_limits<double>::infinity();
  const double lower = task.lower.value_or(near.mean - half_width), upper = task.upper.value_or(near.mean + half_width);
  expect_seeds_inside(task, lower, upper);
  const Mask candidates = within(task, lower, upper);
  return {pieces_with(candidates, task.seeds), lower, upper};
}

}  // namespace

Method region_growing() {
  return {
      {"segmentation",
       "region_growing",
       "What hangs together with a seed through voxels with an intensity in an interval, given or taken from around the seeds.",
       "R. Adams & L. Bischof, Seeded region growing, IEEE Trans. PAMI 16 (1994), with a fixed criterion",
       {{"threshold-lower", "1", {}, 0, "lowest intensity; open when only the other is given"},
        {"threshold-upper", "1", {}, 0, "highest intensity; open when only the other is given"},
        {"neighbourhood-mm", "mm", {0, 1000}, 2, "radius around a seed whose statistics are used"},
        {"interval-sd", "1", {0, 100}, 2.5, "half width of that interval, in standard deviations"}}},
      choose};
}

}  // namespace palpate::segmentation
