// Taubin smoothing and the volume-restoring offset.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/smooth.hpp>

#include <cmath>

#include <pipeline/surface/measure.hpp>

namespace palpate {
namespace {

/// x += factor · (mean of the neighbours − x). On a closed surface every neighbour is met twice, so the mean may count sides.
void umbrella_step(Surface& surface, double factor) {
  std::vector<Vec3> sum(surface.points.size(), Vec3{0, 0, 0});
  std::vector<int> count(surface.points.size(), 0);
  for (const auto& t : surface.triangles)
    for (int c = 0; c < 3; ++c) {
      sum[t[c]] = sum[t[c]] + surface.points[t[(c + 1) % 3]] + surface.points[t[(c + 2) % 3]];
      count[t[c]] += 2;
    }
  for (std::size_t p = 0; p < surface.points.size(); ++p)
    if (count[p] > 0) surface.points[p] = surface.points[p] + factor * ((1.0 / count[p]) * sum[p] - surface.points[p]);
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
  for (int pass = 0; pass < passes; ++pass) {
    umbrella_step(surface, 0.5);
    umbrella_step(surface, -0.53);
  }
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
