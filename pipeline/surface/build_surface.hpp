// Labels → closed, smooth, evenly triangulated surface, with a ledger of its volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <pipeline/surface/mask.hpp>
#include <pipeline/surface/repair.hpp>
#include <palpate/mesh_files.hpp>

namespace palpate {

struct SurfaceOptions {
  MaskOptions mask;
  double smooth_mm =
      0;  ///< standard deviation of the Gaussian; 0: 1.5 times the coarsest spacing, at least a third of the edge length
  double edge_mm = 0;  ///< of the triangles; 0: a twentieth of the cube root of the largest piece's volume
  double hole_mm = 0;  ///< largest hole of a brought surface to close; 0: a fifth of its bounding box's diagonal
  int steps = 10;      ///< towards agreement with the voxels
  int iterations = 8;  ///< of the remeshing
};

/// What happened on the way, for the card.
struct SurfaceLedger {
  MaskLedger mask;      ///< of labels
  RepairLedger repair;  ///< of a brought surface
  bool cut = false;     ///< labels reach the edge of their volume
  double step_mm = 0, edge_mm = 0;
  std::array<double, 3> sigma_mm{0, 0, 0};  ///< along the voxel axes
  double voxels_mm3 = 0, raw_mm3 = 0, final_mm3 = 0;
  double offset_mm = 0;  ///< along the normals, to restore the volume after remeshing
  std::size_t raw_triangles = 0;
  std::vector<std::string> attempts;  ///< what was wrong with the tries before this one, if any
  int crumbs = 0;                     ///< small shells of the contour that were left out
  double crumbs_mm3 = 0;
};

/// Tells the person how far it is.
using Tell = std::function<void(const std::string&)>;

/// The surface of the chosen labels; region of a triangle: the nearest label. Where a tunnel or neck is too thin for triangles of
/// that size (a self-intersection or a needle is left), it is tried again without putting back what the Gaussian blurs away, then
/// with a wider Gaussian, five tries at most; the last is returned as it is.
Surface build_surface(const Labels& labels, const SurfaceOptions& options, SurfaceLedger& ledger, const Tell& tell);

/// The same from a triangle surface brought from elsewhere: repaired, remeshed, smoothed by Taubin's filter, its volume restored.
Surface rebuild_surface(const Surface& brought, const SurfaceOptions& options, SurfaceLedger& ledger, const Tell& tell);

}  // namespace palpate
