// Which label lies under each triangle.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <set>

#include <palpate/mesh_files.hpp>
#include <palpate/volume.hpp>

namespace palpate {

/// For each triangle the label of the nearest voxel (centre to centre, mm) whose label is in `chosen` (empty: any above zero),
/// searched within `reach_mm`; ties go to the smaller label, and triangles with no voxel in reach to the most frequent label.
std::vector<int> nearest_labels(const Surface& surface, const Labels& labels, const std::set<int>& chosen, double reach_mm);

}  // namespace palpate
