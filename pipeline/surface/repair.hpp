// A triangle surface brought from elsewhere: read, mended and closed, or refused with the place of what cannot be mended.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

/// True for the file endings of triangle surfaces: .vtp .stl .ply .obj
bool is_surface_file(const std::filesystem::path& path);

/// Reads one of them; polygons are cut into triangles, region 1 where the format has none. Coordinates are taken as patient LPS
/// in mm. Throws Failure(unreadable).
Surface read_brought_surface(const std::filesystem::path& path);

/// A hole that was closed.
struct Hole {
  int edges = 0;
  double across_mm = 0;  ///< diagonal of its bounding box
  Vec3 centre_mm{0, 0, 0};
};

struct RepairLedger {
  long points_in = 0, triangles_in = 0;          ///< as read
  long points_mended = 0, triangles_mended = 0;  ///< after duplicates and degenerate triangles are gone and borders are stitched
  std::vector<Hole> holes;
};

/// Merges duplicate points and triangles, orients, splits points where sheets touch, stitches borders, removes degenerate
/// triangles, closes holes up to `hole_mm` across and turns all shells outward. Throws Failure(check_failed) naming place and
/// size of a hole that is larger or has no sound patch, and of the first self-intersection. Regions: of the nearest triangle of
/// the surface as read.
Surface repair(const Surface& brought, double hole_mm, RepairLedger& ledger);

}  // namespace palpate
