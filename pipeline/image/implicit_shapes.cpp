// Solids as functions of space, |∇f| ≤ 1.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/implicit_shapes.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numbers>

namespace palpate {
namespace {

/// Distance from x to the segment a–b.
double segment_distance(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0 ? std::clamp(dot(x - a, ab) / length2, 0.0, 1.0) : 0.0;
  return norm(x - (a + t * ab));
}

struct Segment {
  Vec3 start, along;
  double inverse_length2;
};

/// A few segments of a polyline and a ball around them, to pass over them where they are far.
struct Run {
  std::vector<Segment> segments;
  Vec3 centre;
  double radius;

  /// Square of the distance from x to the nearest of the segments.
  double distance2(const Vec3& x) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Segment& s : segments) {
      const Vec3 d = x - s.start;
      const double t = std::clamp(dot(d, s.along) * s.inverse_length2, 0.0, 1.0);
      const Vec3 gap = d - t * s.along;
      nearest = std::min(nearest, dot(gap, gap));
    }
    return nearest;
  }
};

std::vector<Run> runs_of(const std::vector<Vec3>& points) {
  constexpr std::size_t length = 8;
  std::vector<Run> runs;
  for (std::size_t first = 0; first + 1 < points.size(); first += length) {
    const std::size_t last = std::min(first + length, points.size() - 1);
    Run run{{}, 0.5 * (points[first] + points[last]), 0};
    for (std::size_t i = first; i <= last; ++i) run.radius = std::max(run.radius, norm(points[i] - run.centre));
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 along = points[i + 1] - points[i];
      run.segments.push_back({points[i], along, 1 / std::max(dot(along, along), 1e-300)});
    }
    runs.push_back(run);
  }
  return runs;
}

/// Quadratic polynomial minimum: min(a, b) − (w − |a − b|)²/(4 w) where |a − b| < w. Its gradient is a convex combination.
double smooth_min(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0);
  return std::min(a, b) - (width > 0 ? h * h / (4 * width) : 0.0);
}

}  // namespace

Implicit ball(const Vec3& centre, double radius) {
  return [=](const Vec3& x) { return norm(x - centre) - radius; };
}

Implicit capsule(const Vec3& a, const Vec3& b, double radius) {
  return [=](const Vec3& x) { return segment_distance(x, a, b) - radius; };
}

Implicit round_cone(const Vec3& a, double ra, const Vec3& b, double rb) {
  const double length = norm(b - a);
  assert(std::abs(ra - rb) < length);
  const Vec3 axis = (1 / length) * (b - a);
  const double slope = (ra - rb) / length;            // sine of the cone's half angle
  const double cosine = std::sqrt(1 - slope * slope);
  return [=](const Vec3& x) {
    const double along = dot(x - a, axis);
    const double across = std::sqrt(std::max(0.0, dot(x - a, x - a) - along * along));
    const double foot = along - across * slope / cosine;  // where the normal of the cone through x meets the axis
    if (foot <= 0) return norm(x - a) - ra;
    if (foot >= length) return norm(x - b) - rb;
    return across * cosine + along * slope - ra;
  };
}

Implicit arc_tube(const Vec3& centre, double arc_radius, double half_angle, double radius) {
  assert(half_angle >= 0 && half_angle <= std::numbers::pi);
  const double cosine = std::cos(half_angle), sine = std::sin(half_angle);
  return [=](const Vec3& x) {
    const Vec3 d = x - centre;
    const double rho = std::sqrt(d[0] * d[0] + d[2] * d[2]);
    if (d[0] >= rho * cosine) return std::sqrt((rho - arc_radius) * (rho - arc_radius) + d[1] * d[1]) - radius;
    return norm(d - arc_radius * Vec3{cosine, 0, d[2] < 0 ? -sine : sine}) - radius;
  };
}

Implicit polyline_tube(const std::vector<Vec3>& points, double radius) {
  assert(points.size() >= 2);
  return [runs = runs_of(points), radius](const Vec3& x) {
    const auto at_least = [&](const Run& run) { return norm(x - run.centre) - run.radius; };
    const Run* likely = &runs.front();
    double lowest = std::numeric_limits<double>::infinity();
    for (const Run& run : runs)
      if (const double bound = at_least(run); bound < lowest) lowest = bound, likely = &run;
    double nearest = std::sqrt(likely->distance2(x));
    for (const Run& run : runs)
      if (&run != likely && at_least(run) < nearest) nearest = std::min(nearest, std::sqrt(run.distance2(x)));
    return nearest - radius;
  };
}

Implicit smooth_union(Implicit a, Implicit b, double width) {
  return [a = std::move(a), b = std::move(b), width](const Vec3& x) { return smooth_min(a(x), b(x), width); };
}

Implicit smooth_difference(Implicit a, Implicit b, double width) {
  return [a = std::move(a), b = std::move(b), width](const Vec3& x) { return -smooth_min(-a(x), b(x), width); };
}

Implicit intersection(Implicit a, Implicit b) {
  return [a = std::move(a), b = std::move(b)](const Vec3& x) { return std::max(a(x), b(x)); };
}

Implicit offset(Implicit a, double distance) {
  return [a = std::move(a), distance](const Vec3& x) { return a(x) - distance; };
}

Implicit stretched(Implicit a, const Vec3& factors) {
  const double shrink = std::min({1.0, factors[0], factors[1], factors[2]});
  return [a = std::move(a), factors, shrink](const Vec3& x) {
    return shrink * a({x[0] / factors[0], x[1] / factors[1], x[2] / factors[2]});
  };
}

Implicit moved(Implicit a, const Affine& new_from_own) {
  return [a = std::move(a), own_from_new = new_from_own.inverse()](const Vec3& x) { return a(own_from_new(x)); };
}

Vec3 gradient(const Implicit& f, const Vec3& x, double step) {
  Vec3 g{};
  for (int i = 0; i < 3; ++i) {
    Vec3 ahead = x, behind = x;
    ahead[i] += step;
    behind[i] -= step;
    g[i] = (f(ahead) - f(behind)) / (2 * step);
  }
  return g;
}

Vec3 project_to_zero(const Implicit& f, const Vec3& start, double reach) {
  Vec3 x = start;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const double value = f(x);
    if (std::abs(value) < 1e-10) break;
    const Vec3 g = gradient(f, x, 1e-4);
    const double g2 = dot(g, g);
    if (!(g2 > 1e-6)) break;
    const Vec3 next = x - (value / g2) * g;
    if (norm(next - start) > reach) break;
    x = next;
  }
  return x;
}

}  // namespace palpate
