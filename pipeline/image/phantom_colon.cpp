// Colon: a tube around a Catmull–Rom curve, with a row of sacs (haustra) joined by folds; the wall is an offset of the lumen.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/phantom_organs.hpp>

#include <algorithm>
#include <limits>

namespace palpate {
namespace {

/// Point of the uniform Catmull–Rom spline between p1 and p2, t in [0, 1] (Catmull and Rom 1974).
Vec3 catmull_rom(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3, double t) {
  const Vec3 a = 2.0 * p1, b = p2 - p0, c = 2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3, d = 3.0 * p1 - p0 - 3.0 * p2 + p3;
  return 0.5 * (a + t * b + (t * t) * c + (t * t * t) * d);
}

/// The curve as a polyline with steps of about `step` mm.
std::vector<Vec3> curve(const std::vector<Vec3>& p, double step) {
  std::vector<Vec3> points{p.front()};
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const Vec3 before = i > 0 ? p[i - 1] : 2.0 * p[0] - p[1];
    const Vec3 after = i + 2 < p.size() ? p[i + 2] : 2.0 * p[i + 1] - p[i];
    const int steps = std::max(1, static_cast<int>(std::ceil(norm(p[i + 1] - p[i]) / step)));
    for (int s = 1; s <= steps; ++s) points.push_back(catmull_rom(before, p[i], p[i + 1], after, double(s) / steps));
  }
  return points;
}

/// Length along the polyline from its start to each of its points.
std::vector<double> arc_lengths(const std::vector<Vec3>& points) {
  std::vector<double> s{0};
  for (std::size_t i = 1; i < points.size(); ++i) s.push_back(s.back() + norm(points[i] - points[i - 1]));
  return s;
}

/// Points at equal distances near `spacing` along the polyline, both ends included.
std::vector<Vec3> equally_spaced(const std::vector<Vec3>& points, double spacing) {
  const auto s = arc_lengths(points);
  const int steps = std::max(1, static_cast<int>(std::round(s.back() / spacing)));
  std::vector<Vec3> list;
  std::size_t i = 1;
  for (int k = 0; k <= steps; ++k) {
    const double at = s.back() * k / steps;
    while (i + 1 < points.size() && s[i] < at) ++i;
    list.push_back(points[i - 1] + ((at - s[i - 1]) / (s[i] - s[i - 1])) * (points[i] - points[i - 1]));
  }
  return list;
}

/// Balls of one radius about many centres.
Implicit balls(std::vector<Vec3> centres, double radius) {
  return [centres = std::move(centres), radius](const Vec3& x) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& c : centres) nearest = std::min(nearest, dot(x - c, x - c));
    return std::sqrt(nearest) - radius;
  };
}

double step_of(const ColonShape& c) { return 0.15 * c.lumen_radius_mm; }

}  // namespace

std::string defect_of(const ColonShape& c) {
  if (c.centreline_mm.size() < 2) return "a centreline needs at least two points";
  for (std::size_t i = 1; i < c.centreline_mm.size(); ++i)
    if (!(norm(c.centreline_mm[i] - c.centreline_mm[i - 1]) > 1e-3)) return "two points of the centreline coincide";
  if (!(c.haustra_depth_mm <= 0.6 * c.lumen_radius_mm)) return "the folds are deeper than 0.6 times the lumen's radius";
  if (!(c.haustra_spacing_mm >= 0.5 * c.lumen_radius_mm)) return "the haustra are closer than half the lumen's radius";
  const auto points = curve(c.centreline_mm, step_of(c));
  const auto s = arc_lengths(points);
  const double outer = c.lumen_radius_mm + c.wall_mm;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (s[i] - s[j] > 3.3 * outer && norm(points[i] - points[j]) < 2 * outer)
        return "the tube meets itself: its centreline turns tighter than its outer radius or comes back too near";
  return "";
}

Organ colon(const ColonShape& c) {
  const auto points = curve(c.centreline_mm, step_of(c));
  Implicit lumen = polyline_tube(points, c.lumen_radius_mm - c.haustra_depth_mm);
  if (c.haustra_depth_mm > 0)
    lumen = smooth_union(lumen, balls(equally_spaced(points, c.haustra_spacing_mm), c.lumen_radius_mm), 0.5 * c.haustra_depth_mm);

  Organ organ;
  organ.name = "colon";
  organ.body_part = "COLON";
  organ.shape = offset(lumen, c.wall_mm);
  organ.parts = {{"lumen", 2, lumen, c.lumen}, {"wall", 1, organ.shape, c.wall}};
  const double reach = c.lumen_radius_mm + c.wall_mm + 0.125 * c.haustra_depth_mm;
  organ.box = {points.front(), points.front()};
  for (const Vec3& p : points)
    for (int i = 0; i < 3; ++i) {
      organ.box.min[i] = std::min(organ.box.min[i], p[i] - reach);
      organ.box.max[i] = std::max(organ.box.max[i], p[i] + reach);
    }
  organ.seed = points[points.size() / 2];
  return organ;
}

}  // namespace palpate
