// Measuring a label.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/label_facts.hpp>

#include <pipeline/image/components.hpp>
#include <pipeline/image/places.hpp>

namespace palpate {
namespace {

Vec3 centre_of(const Mask& mask) {
  Vec3 sum{0, 0, 0};
  double count = 0;
  for (int k = 0; k < mask.grid.size[2]; ++k)
    for (int j = 0; j < mask.grid.size[1]; ++j)
      for (int i = 0; i < mask.grid.size[0]; ++i) {
        if (!mask(i, j, k)) continue;
        sum = sum + Vec3{double(i), double(j), double(k)};
        ++count;
      }
  return mask.grid.lps_from_voxel((1 / count) * sum);
}

}  // namespace

LabelFacts label_facts(const Scan& scan, const Mask& mask) {
  LabelFacts facts;
  std::vector<float> inside, outside;
  for (std::size_t p = 0; p < mask.voxels.size(); ++p) (mask.voxels[p] ? inside : outside).push_back(scan.voxels[p]);
  facts.voxels = inside.size();
  facts.pieces = components_of(mask).voxels.size();
  facts.volume_mm3 = static_cast<double>(facts.voxels) * mask.grid.voxel_mm3();
  facts.fraction_of_scan = static_cast<double>(facts.voxels) / static_cast<double>(mask.voxels.size());
  facts.inside = statistics_of(inside);
  facts.outside = statistics_of(outside);
  const Block block = bounding_block(mask);
  facts.box_mm = box_mm(mask.grid, block);
  facts.centre_mm = centre_of(mask);
  for (int a = 0; a < 3; ++a)
    if (mask.grid.size[a] > 1 && (block.first[a] == 0 || block.last[a] == mask.grid.size[a] - 1)) facts.touched_axes.push_back(a);
  return facts;
}

}  // namespace palpate
