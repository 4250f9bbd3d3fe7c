// What all phantom organs share: which tissue is where, and moving them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/phantom_organs.hpp>

#include <algorithm>

namespace palpate {

int part_at(const Organ& organ, const Vec3& x) {
  if (organ.shape(x) > 0) return outside;
  const int last = static_cast<int>(organ.parts.size()) - 1;
  for (int p = 0; p < last; ++p)
    if (organ.parts[p].shape(x) <= 0) return p;
  return last;
}

Organ moved(const Organ& organ, const Affine& pose) {
  Organ result = organ;
  result.shape = moved(organ.shape, pose);
  for (OrganPart& part : result.parts) part.shape = moved(part.shape, pose);
  result.seed = pose(organ.seed);
  result.press_axis = pose.linear(organ.press_axis);
  result.box = {pose(organ.box.min), pose(organ.box.min)};
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 x;
    for (int i = 0; i < 3; ++i) x[i] = corner >> i & 1 ? organ.box.max[i] : organ.box.min[i];
    x = pose(x);
    for (int i = 0; i < 3; ++i) {
      result.box.min[i] = std::min(result.box.min[i], x[i]);
      result.box.max[i] = std::max(result.box.max[i], x[i]);
    }
  }
  return result;
}

}  // namespace palpate
