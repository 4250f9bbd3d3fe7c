// Nearest label, by search in a box of voxels that grows until nothing nearer can lie outside it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/regions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace palpate {
namespace {

struct Search {
  const Labels& labels;
  const std::set<int>& chosen;
  Affine voxel_from_lps;
  Vec3 spacing;

  bool wanted(int label) const { return label != 0 && (chosen.empty() || chosen.contains(label)); }

  /// The nearest wanted label in the box of voxels within `radius_mm` of x; 0 when there is none within that distance.
  int within(const Vec3& x, double radius_mm) const {
    const Vec3 v = voxel_from_lps(x);
    std::array<int, 3> low{}, high{};
    for (int a = 0; a < 3; ++a) {
      low[a] = std::max(0, int(std::ceil(v[a] - radius_mm / spacing[a])));
      high[a] = std::min(labels.grid.size[a] - 1, int(std::floor(v[a] + radius_mm / spacing[a])));
    }
    double best = radius_mm * radius_mm;
    int found = 0;
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i) {
          const int label = labels(i, j, k);
          if (!wanted(label)) continue;
          const Vec3 d = labels.grid.lps_from_voxel({double(i), double(j), double(k)}) - x;
          const double distance = dot(d, d);
          if (distance < best || (distance == best && (found == 0 || label < found))) best = distance, found = label;
        }
    return found;
  }
};

}  // namespace

std::vector<int> nearest_labels(const Surface& surface, const Labels& labels, const std::set<int>& chosen, double reach_mm) {
  const Search search{labels, chosen, labels.grid.lps_from_voxel.inverse(), labels.grid.spacing()};
  const double first_mm = *std::max_element(search.spacing.begin(), search.spacing.end());
  std::vector<int> regions;
  std::map<int, int> votes;
  for (const auto& t : surface.triangles) {
    const Vec3 centre = (1.0 / 3) * (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]);
    int label = 0;
    for (double radius = first_mm; label == 0; radius *= 2) {
      label = search.within(centre, radius);
      if (radius > reach_mm) break;
    }
    regions.push_back(label);
    ++votes[label];
  }
  votes.erase(0);
  const auto most =
      std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  for (int& region : regions)
    if (region == 0 && most != votes.end()) region = most->first;
  return regions;
}

}  // namespace palpate
