// A block of twelve triangles, as a tool's surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/mesh_files.hpp>

namespace palpate::verify {

/// Corner i + 2 j + 4 k; triangles counter-clockwise from outside.
inline Surface block_surface(const Vec3& low, const Vec3& high) {
  Surface surface;
  for (int corner = 0; corner < 8; ++corner)
    surface.points.push_back({corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1], corner & 4 ? high[2] : low[2]});
  surface.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  surface.triangle_region.assign(surface.triangles.size(), 1);
  surface.region_names = {{1, "tool"}};
  return surface;
}

}  // namespace palpate::verify
