// What the segmentation methods share.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/segmentation.hpp>

#include <stdexcept>

namespace palpate::segmentation {

Method by_name(const std::string& name) {
  for (const Method& method : all())
    if (method.about.name == name) return method;
  throw std::logic_error("no segmentation method " + name);
}

Mask within(const Task& task, double lower, double upper) {
  Mask mask = task.domain;
  for (std::size_t p = 0; p < mask.voxels.size(); ++p)
    mask.voxels[p] = mask.voxels[p] && task.scan.voxels[p] >= lower && task.scan.voxels[p] <= upper;
  return mask;
}

std::vector<float> intensities_of(const Scan& scan, const Mask& domain) {
  std::vector<float> values;
  for (std::size_t p = 0; p < domain.voxels.size(); ++p)
    if (domain.voxels[p]) values.push_back(scan.voxels[p]);
  return values;
}

}  // namespace palpate::segmentation
