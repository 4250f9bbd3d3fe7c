// Cores by the nearest mean, then growth in layers (seeded region growing without a priority by intensity; Adams & Bischof 1994).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dividing.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <palpate/errors.hpp>
#include <pipeline/image/components.hpp>
#include <pipeline/image/morphology.hpp>

namespace palpate {
namespace {

std::string place_of(const Grid& grid, const VoxelIndex& v) {
  const Vec3 mm = grid.lps_from_voxel({double(v[0]), double(v[1]), double(v[2])});
  std::ostringstream text;
  text << "seed at " << mm[0] << "," << mm[1] << "," << mm[2] << " mm";
  return text.str();
}

/// Mean over the voxels of `inside` whose centres are within `radius_mm` of the seed.
double mean_around(const Scan& scan, const Mask& inside, const VoxelIndex& seed, double radius_mm) {
  const Vec3 h = scan.grid.spacing();
  double sum = 0;
  int count = 0;
  const auto range = [&](int a) {
    const int reach = static_cast<int>(radius_mm / h[a]);
    return std::pair{std::max(0, seed[a] - reach), std::min(scan.grid.size[a] - 1, seed[a] + reach)};
  };
  for (int k = range(2).first; k <= range(2).second; ++k)
    for (int j = range(1).first; j <= range(1).second; ++j)
      for (int i = range(0).first; i <= range(0).second; ++i) {
        if (!inside(i, j, k) || !(std::hypot(h[0] * (i - seed[0]), h[1] * (j - seed[1]), h[2] * (k - seed[2])) <= radius_mm)) continue;
        sum += scan(i, j, k);
        ++count;
      }
  return sum / count;
}

std::vector<double> means_of(const Scan& scan, const Mask& inner, const std::vector<VoxelIndex>& seeds, double radius_mm) {
  std::vector<double> means;
  for (const auto& seed : seeds) {
    if (!inner(seed[0], seed[1], seed[2]))
      throw Failure(ExitCode::misuse, "a part's seed lies outside the organ, or nearer to its rim than one voxel and a half", place_of(scan.grid, seed),
                    "a seed in the middle of the part");
    means.push_back(mean_around(scan, inner, seed, radius_mm));
    for (std::size_t other = 0; other + 1 < means.size(); ++other)
      if (means[other] == means.back()) throw Failure(ExitCode::refused, "two parts have the same intensity", place_of(scan.grid, seed), "another seed");
  }
  return means;
}

std::size_t nearest(const std::vector<double>& means, double value) {
  return std::min_element(means.begin(), means.end(), [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); }) - means.begin();
}

/// The labels spread by one layer of face neighbours at a time, each front in order of its label and place.
void grow(Labels& labels, const Mask& mask, std::size_t parts) {
  std::vector<std::vector<std::size_t>> fronts(parts);
  for (std::size_t v = 0; v < labels.voxels.size(); ++v)
    if (labels.voxels[v]) fronts[labels.voxels[v] - 1].push_back(v);
  const auto any = [&] { return std::any_of(fronts.begin(), fronts.end(), [](const auto& f) { return !f.empty(); }); };
  while (any())
    for (std::size_t p = 0; p < parts; ++p) {
      std::vector<std::size_t> next;
      for (std::size_t v : fronts[p])
        for_each_face_neighbour(mask.grid, v, [&](std::size_t w) {
          if (!mask.voxels[w] || labels.voxels[w]) return;
          labels.voxels[w] = static_cast<std::uint16_t>(p + 1);
          next.push_back(w);
        });
      fronts[p] = std::move(next);
    }
}

}  // namespace

Labels divided(const Scan& scan, const Mask& mask, const std::vector<VoxelIndex>& seeds, double neighbourhood_mm) {
  const Vec3 h = scan.grid.spacing();
  const Mask inner = eroded(mask, 1.5 * *std::max_element(h.begin(), h.end()));
  const auto means = means_of(scan, inner, seeds, neighbourhood_mm);
  Labels labels{scan.grid, std::vector<std::uint16_t>(scan.voxels.size(), 0)};
  for (std::size_t p = 0; p < seeds.size(); ++p) {
    const auto of_part = [&](std::size_t v) { return inner.voxels[v] && nearest(means, scan.voxels[v]) == p; };
    const Mask core = flooded(scan.grid, {seeds[p]}, of_part);
    for (std::size_t v = 0; v < core.voxels.size(); ++v)
      if (core.voxels[v]) labels.voxels[v] = static_cast<std::uint16_t>(p + 1);
  }
  grow(labels, mask, seeds.size());
  return labels;
}

}  // namespace palpate
