// What a label looks like in numbers: size, place, intensities inside and outside, and whether the scan cuts it off.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <pipeline/image/histogram.hpp>
#include <pipeline/image/mask.hpp>

namespace palpate {

struct LabelFacts {
  std::size_t voxels = 0, pieces = 0;
  double volume_mm3 = 0, fraction_of_scan = 0;
  std::array<Vec3, 2> box_mm;     ///< patient box, lowest and highest coordinates
  Vec3 centre_mm{0, 0, 0};        ///< centre of mass
  Statistics inside, outside;     ///< intensities of the scan (not smoothed)
  std::vector<int> touched_axes;  ///< voxel axes along which the label reaches the first or last slice of the scan
};

/// Requires a mask that is not empty.
LabelFacts label_facts(const Scan& scan, const Mask& mask);

}  // namespace palpate
