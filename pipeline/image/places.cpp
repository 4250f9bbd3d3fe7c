// Millimetres to voxels and back.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/places.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

std::string text_of(const Vec3& p) {
  char text[96];
  std::snprintf(text, sizeof text, "%.2f,%.2f,%.2f mm", p[0], p[1], p[2]);
  return text;
}

std::string text_of(const std::array<Vec3, 2>& box) {
  char text[160];
  std::snprintf(text, sizeof text, "x %.2f to %.2f, y %.2f to %.2f, z %.2f to %.2f mm", box[0][0], box[1][0], box[0][1],
                box[1][1], box[0][2], box[1][2]);
  return text;
}

}  // namespace

std::array<Vec3, 2> box_mm(const Grid& grid, const Block& block) {
  std::array<Vec3, 2> box{Vec3{1e300, 1e300, 1e300}, Vec3{-1e300, -1e300, -1e300}};
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 voxel;
    for (int a = 0; a < 3; ++a) voxel[a] = corner >> a & 1 ? block.last[a] + 0.5 : block.first[a] - 0.5;
    const Vec3 mm = grid.lps_from_voxel(voxel);
    for (int a = 0; a < 3; ++a) {
      box[0][a] = std::min(box[0][a], mm[a]);
      box[1][a] = std::max(box[1][a], mm[a]);
    }
  }
  return box;
}

std::string extent_text(const Grid& grid) {
  return text_of(box_mm(grid, {{0, 0, 0}, {grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1}}));
}

std::vector<VoxelIndex> voxels_at(const Grid& grid, const std::vector<Vec3>& points) {
  const Affine voxel_from_lps = grid.lps_from_voxel.inverse();
  std::vector<VoxelIndex> voxels;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3 v = voxel_from_lps(points[n]);
    VoxelIndex voxel;
    for (int a = 0; a < 3; ++a) {
      if (!(v[a] >= -0.5 && v[a] < grid.size[a] - 0.5))
        throw Failure(ExitCode::misuse, "seed " + std::to_string(n + 1) + " lies outside the scan",
                      text_of(points[n]) + "; the scan fills " + extent_text(grid),
                      "a point inside, in patient LPS (x to the left, y to the back, z to the head)");
      voxel[a] = static_cast<int>(std::floor(v[a] + 0.5));
    }
    voxels.push_back(voxel);
  }
  return voxels;
}

Mask box_mask(const Grid& grid, const std::vector<Vec3>& corners) {
  Mask mask{grid, std::vector<std::uint8_t>(grid.count(), 1)};
  if (corners.empty()) return mask;
  if (corners.size() != 2)
    throw Failure(ExitCode::misuse, "a box has two opposite corners, not " + std::to_string(corners.size()), "--box",
                  "--box x,y,z --box x,y,z");
  std::array<Vec3, 2> box = {corners[0], corners[1]};
  for (int a = 0; a < 3; ++a)
    if (box[0][a] > box[1][a]) std::swap(box[0][a], box[1][a]);
  std::size_t inside = 0;
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i) {
        const Vec3 p = grid.lps_from_voxel({double(i), double(j), double(k)});
        bool in = true;
        for (int a = 0; a < 3; ++a) in = in && p[a] >= box[0][a] && p[a] <= box[1][a];
        mask(i, j, k) = in;
        inside += in;
      }
  if (inside == 0)
    throw Failure(ExitCode::misuse, "the box holds no voxel", "box " + text_of(box) + "; the scan fills " + extent_text(grid),
                  "a larger box, in patient LPS");
  return mask;
}

}  // namespace palpate
