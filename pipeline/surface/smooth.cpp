// Taubin smoothing and the volume-restoring offset.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/smooth.hpp>

#include <cmath>

#include <pipeline/surface/measure.hpp>

namespace palpate {
namespace {

/// x += factor · (mean of the neighbours − x) where `moves`. On a closed surface every neighbour is met twice, so the mean may
/// count sides.
void umbrella_step(Surface& surface, double factor, const std::vector<bool>& moves) {
  std::vector<Vec3> sum(surface.points.size(), Vec3{0, 0, 0});
  std::vector<int> count(surface.points.size(), 0);
  for (const auto& t : surface.triangles)
    for (int c = 0; c < 3; ++c) {
      sum[t[c]] = sum[t[c]] + surface.points[t[(c + 1) % 3]] + surface.points[t[(c + 2) % 3]];
      count[t[c]] += 2;
    }
  for (std::size_t p = 0; p < surface.points.size(); ++p)
    if (moves[p] && count[p] > 0)
      surface.points[p] = surface.points[p] + factor * ((1.0 / count[p]) * sum[p] - surface.points[p]);
}

/// One third of the area vectors of the triangles around each point.
std::vector<Vec3> area_vectors(const Surface& surface) {
  std::vector<Vec3> area(surface.points.size(), Vec3{0, 0, 0});
  for (const auto& t : surface.triangles) {
    const Vec3& x = surface.points[t[0]];
    const Vec3 a = (1.0 / 6) * cross(surface.points[t[1]] - x, surface.points[t[2]] - x);
    for (int p : t) area[p] = area[p] + a;
  }
  return area;
}

}  // namespace

void taubin_smooth(Surface& surface, int passes) {
  const std::vector<bool> all(surface.points.size(), true);
  for (int pass = 0; pass < passes; ++pass) {
    umbrella_step(surface, 0.5, all);
    umbrella_step(surface, -0.53, all);
  }
}

void relax_around(Surface& surface, const std::vector<int>& triangles, int rings, int passes) {
  std::vector<bool> moves(surface.points.size(), false);
  for (int t : triangles)
    for (int p : surface.triangles[t]) moves[p] = true;
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<bool> wider = moves;
    for (const auto& t : surface.triangles)
      if (moves[t[0]] || moves[t[1]] || moves[t[2]])
        for (int p : t) wider[p] = true;
    moves = std::move(wider);
  }
  for (int pass = 0; pass < passes; ++pass) umbrella_step(surface, 0.5, moves);
}

double restore_volume(Surface& surface, double mm3) {
  double moved = 0;
  for (int step = 0; step < 5; ++step) {
    const double missing = mm3 - volume_mm3(surface);
    if (std::abs(missing) <= 1e-6 * std::abs(mm3)) break;
    const auto area = area_vectors(surface);
    double slope = 0;
    for (const Vec3& a : area) slope += norm(a);
    const double offset = missing / slope;
    for (std::size_t p = 0; p < area.size(); ++p)
      if (norm(area[p]) > 0) surface.points[p] = surface.points[p] + offset * unit(area[p]);
    moved += offset;
  }
  return moved;
}

}  // namespace palpate
