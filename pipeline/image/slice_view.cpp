// Voxel axes matched to patient axes, largest cosine first.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/slice_view.hpp>

#include <cmath>
#include <string>

namespace palpate {
namespace {

/// [patient axis] = voxel axis, each used once.
std::array<int, 3> voxel_axis_of_patient_axis(const Grid& grid) {
  std::array<int, 3> voxel_of{-1, -1, -1};
  std::array<bool, 3> used{false, false, false};
  for (int round = 0; round < 3; ++round) {
    double best = -1;
    int best_voxel = 0, best_patient = 0;
    for (int v = 0; v < 3; ++v)
      for (int p = 0; p < 3; ++p) {
        const double cosine = std::abs(unit(grid.lps_from_voxel.columns[v])[p]);
        if (used[v] || voxel_of[p] >= 0 || cosine <= best + 1e-9) continue;
        best = cosine;
        best_voxel = v;
        best_patient = p;
      }
    voxel_of[best_patient] = best_voxel;
    used[best_voxel] = true;
  }
  return voxel_of;
}

}  // namespace

SliceView view_through(const Grid& grid, int through) {
  const auto voxel_of = voxel_axis_of_patient_axis(grid);
  SliceView view;
  view.through = through;
  for (int p = 0; p < 3; ++p)
    if (voxel_of[p] == through) view.normal = p;
  // Patient axes shown to the right and down: axial L, P; coronal L, F; sagittal P, F.
  const int right_axis = view.normal == 0 ? 1 : 0, down_axis = view.normal == 2 ? 1 : 2;
  const double right_sign = 1, down_sign = down_axis == 2 ? -1 : 1;
  view.patient_across = right_axis;
  view.patient_down = down_axis;
  view.across = voxel_of[right_axis];
  view.down = voxel_of[down_axis];
  view.flip_across = grid.lps_from_voxel.columns[view.across][right_axis] * right_sign < 0;
  view.flip_down = grid.lps_from_voxel.columns[view.down][down_axis] * down_sign < 0;
  const std::string low = "RAF", high = "LPH";
  view.left = low[right_axis];
  view.right = high[right_axis];
  view.top = down_sign > 0 ? low[down_axis] : high[down_axis];
  view.bottom = down_sign > 0 ? high[down_axis] : low[down_axis];
  return view;
}

int coarsest_axis(const Grid& grid) {
  const Vec3 h = grid.spacing();
  int coarsest = 0;
  for (int a = 1; a < 3; ++a)
    if (h[a] >= h[coarsest] * (1 - 1e-6)) coarsest = a;
  return coarsest;
}

}  // namespace palpate
