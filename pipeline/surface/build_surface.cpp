// mask → smooth field → contour at the volume of the voxels → remeshing → volume restored → regions.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/build_surface.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <palpate/errors.hpp>
#include <pipeline/surface/checks.hpp>
#include <pipeline/surface/contour.hpp>
#include <pipeline/surface/even_triangles.hpp>
#include <pipeline/surface/distance.hpp>
#include <pipeline/surface/field.hpp>
#include <pipeline/surface/measure.hpp>
#include <pipeline/surface/regions.hpp>
#include <pipeline/surface/smooth.hpp>

namespace palpate {
namespace {

constexpr double lattice_nodes_max = 6e7;  ///< 240 MB a field

std::string mm_text(double mm) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", mm);
  return text;
}

/// Fine enough for the triangles and the voxels, coarser only where the lattice would not fit.
double lattice_step(const Grid& grid, double edge_mm) {
  const Vec3 spacing = grid.spacing();
  double box_mm3 = 1;
  for (int axis = 0; axis < 3; ++axis) box_mm3 *= grid.size[axis] * spacing[axis];
  const double finest = *std::min_element(spacing.begin(), spacing.end());
  return std::max({edge_mm / 2, finest / 2, std::cbrt(box_mm3 / lattice_nodes_max)});
}

/// Blurring may leave crumbs where labels were thin, and bubbles where they were porous: less than half of what a piece must
/// have.
Surface without_small_shells(const Surface& surface, const MaskOptions& options, SurfaceLedger& ledger) {
  ledger.crumbs = 0, ledger.crumbs_mm3 = 0;
  const auto all = shells(surface);
  const double least_mm3 = std::max(0.5 * options.min_piece, 1e-4) * all.front().volume_mm3;
  std::vector<bool> kept(surface.triangles.size(), false);
  for (const Shell& shell : all) {
    const bool keep = shell.volume_mm3 >= least_mm3 || (options.keep_cavities && -shell.volume_mm3 >= least_mm3);
    if (!keep) ++ledger.crumbs, ledger.crumbs_mm3 += std::abs(shell.volume_mm3);
    for (int t : shell.triangles) kept[t] = keep;
  }
  return part_of(surface, kept);
}

/// One try with a Gaussian of `smooth_mm` and `steps` towards agreement with the voxels.
Surface attempt(const Mask& mask, double smooth_mm, int steps, const SurfaceOptions& options, SurfaceLedger& ledger,
                const Tell& tell) {
  const Vec3 spacing = mask.grid.spacing();
  const double slack_mm = 0.5 * *std::min_element(spacing.begin(), spacing.end());
  ledger.sigma_mm = gaussian_mm(mask.grid, smooth_mm);
  tell("smoothing over " + mm_text(smooth_mm) + " on a lattice of " + mm_text(ledger.step_mm));
  const Scan weights = consistent_weights(mask, ledger.sigma_mm, slack_mm, steps);
  Surface surface = contour_of_volume(organ_field(weights, ledger.sigma_mm, ledger.step_mm), ledger.voxels_mm3);
  surface = without_small_shells(surface, options.mask, ledger);
  ledger.raw_mm3 = volume_mm3(surface);
  ledger.raw_triangles = surface.triangles.size();
  tell("remeshing " + std::to_string(ledger.raw_triangles) + " triangles to edges of " + mm_text(ledger.edge_mm));
  surface = even_triangles(surface, ledger.edge_mm, options.iterations);
  ledger.offset_mm = restore_volume(surface, ledger.voxels_mm3);
  ledger.final_mm3 = volume_mm3(surface);
  return surface;
}

}  // namespace

Surface build_surface(const Labels& labels, const SurfaceOptions& options, SurfaceLedger& ledger, const Tell& tell) {
  ledger.cut = cut_by_border(labels);
  const Labels box = crop(labels);
  const Mask mask = organ_mask(box, options.mask, ledger.mask);
  ledger.voxels_mm3 = ledger.mask.mm3;
  ledger.edge_mm = options.edge_mm > 0 ? options.edge_mm : std::cbrt(ledger.mask.kept.front().mm3) / 20;
  ledger.step_mm = lattice_step(mask.grid, ledger.edge_mm);
  double smooth_mm = options.smooth_mm > 0 ? options.smooth_mm : std::max(default_smooth_mm(mask.grid), ledger.edge_mm / 3);
  Surface surface;
  for (int tries = 0; tries < 5; ++tries) {
    if (tries > 1) smooth_mm *= 1.2;
    surface = attempt(mask, smooth_mm, tries == 0 ? options.steps : 0, options, ledger, tell);
    SurfaceLimits limits;
    limits.volume_mm3 = ledger.voxels_mm3;
    const auto failed = first_failed(surface_checks(surface, limits));
    if (!failed) break;
    ledger.attempts.push_back("smoothed over " + mm_text(smooth_mm) + ", " + failed->name + " was " + failed->value.dump() +
                              ", " + failed->where);
    tell(ledger.attempts.back());
  }
  const double reach = 4 * *std::max_element(ledger.sigma_mm.begin(), ledger.sigma_mm.end());
  surface.triangle_region = nearest_labels(surface, box, options.mask.labels, reach);
  return surface;
}

Surface rebuild_surface(const Surface& brought, const SurfaceOptions& options, SurfaceLedger& ledger, const Tell& tell) {
  if (brought.triangles.empty())
    throw Failure(ExitCode::check_failed, "the surface has no triangles", "", "look at the file in a viewer");
  Vec3 low = brought.points.front(), high = low;
  for (const Vec3& x : brought.points)
    for (int a = 0; a < 3; ++a) low[a] = std::min(low[a], x[a]), high[a] = std::max(high[a], x[a]);
  const Surface mended = repair(brought, options.hole_mm > 0 ? options.hole_mm : norm(high - low) / 5, ledger.repair);
  ledger.raw_mm3 = volume_mm3(mended);
  ledger.raw_triangles = mended.triangles.size();
  ledger.edge_mm = options.edge_mm > 0 ? options.edge_mm : std::cbrt(shells(mended).front().volume_mm3) / 20;
  tell("remeshing " + std::to_string(ledger.raw_triangles) + " triangles to edges of " + mm_text(ledger.edge_mm));
  Surface surface = even_triangles(mended, ledger.edge_mm, options.iterations);
  const double smooth_mm = options.smooth_mm > 0 ? options.smooth_mm : ledger.edge_mm;
  ledger.sigma_mm = {smooth_mm, smooth_mm, smooth_mm};
  taubin_smooth(surface, std::clamp(int(std::lround(2 * smooth_mm * smooth_mm / (ledger.edge_mm * ledger.edge_mm))), 1, 200));
  ledger.offset_mm = restore_volume(surface, ledger.raw_mm3);
  ledger.final_mm3 = volume_mm3(surface);
  const auto nearest = nearest_triangles(surface, mended);
  for (std::size_t t = 0; t < nearest.size(); ++t) surface.triangle_region[t] = mended.triangle_region[nearest[t]];
  surface.region_names = mended.region_names;
  return surface;
}

}  // namespace palpate
