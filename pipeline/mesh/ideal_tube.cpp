// Rings of corners carried along a line without twist, every second one turned by half a corner; fans close the ends.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/ideal_tube.hpp>

#include <algorithm>
#include <numbers>

#include <palpate/errors.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/nearest_point.hpp>

namespace palpate {
namespace {

Vec3 any_across(const Vec3& t) { return unit(cross(t, std::abs(t[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})); }

void add_triangle(Surface& s, int a, int b, int c, int region) {
  s.triangles.push_back({a, b, c});
  s.triangle_region.push_back(region);
}

/// The end's flat disc: rings of corners drawn to the centre.
void add_end(Surface& s, int first, int corners, const Vec3& centre, double radius, double edge, int region, bool forward) {
  const int rings = std::max(1, static_cast<int>(std::lround(radius / edge)));
  const auto add = [&](int a, int b, int c) { forward ? add_triangle(s, a, b, c, region) : add_triangle(s, a, c, b, region); };
  int outer = first;
  for (int r = 1; r < rings; ++r) {
    const int inner = static_cast<int>(s.points.size());
    for (int k = 0; k < corners; ++k) s.points.push_back(centre + (1 - double(r) / rings) * (s.points[first + k] - centre));
    for (int k = 0; k < corners; ++k) {
      const int l = (k + 1) % corners;
      add(outer + k, outer + l, inner + k);
      add(outer + l, inner + l, inner + k);
    }
    outer = inner;
  }
  s.points.push_back(centre);
  for (int k = 0; k < corners; ++k) add(outer + k, outer + (k + 1) % corners, static_cast<int>(s.points.size()) - 1);
}

/// Points about `step` apart on a polyline, its ends kept.
std::vector<Vec3> even(const std::vector<Vec3>& line, double step) {
  CentreLine l;
  l.points = line;
  for (std::size_t i = 0; i < line.size(); ++i) l.arc.push_back(i == 0 ? 0 : l.arc.back() + norm(line[i] - line[i - 1]));
  const int count = std::max(2, static_cast<int>(std::lround(l.length() / step)));
  std::vector<Vec3> points;
  for (int i = 0; i <= count; ++i) points.push_back(l.at(l.length() * i / count));
  return points;
}

/// Solves A x = b for a small full matrix by elimination with row pivots; false when it is singular.
template <int N>
bool solve(std::array<std::array<double, N>, N>& A, std::array<double, N>& b) {
  for (int k = 0; k < N; ++k) {
    int pivot = k;
    for (int i = k + 1; i < N; ++i)
      if (std::abs(A[i][k]) > std::abs(A[pivot][k])) pivot = i;
    std::swap(A[k], A[pivot]);
    std::swap(b[k], b[pivot]);
    if (!(std::abs(A[k][k]) > 0)) return false;
    for (int i = k + 1; i < N; ++i) {
      const double f = A[i][k] / A[k][k];
      for (int j = k; j < N; ++j) A[i][j] -= f * A[k][j];
      b[i] -= f * b[k];
    }
  }
  for (int k = N - 1; k >= 0; --k) {
    for (int j = k + 1; j < N; ++j) b[k] -= A[k][j] * b[j];
    b[k] /= A[k][k];
  }
  return true;
}

/// One Gauss-Newton step on the wall; returns how far it moves anything, mm.
double improve(Cylinder& c, const Surface& surface, double from, double to) {
  const Vec3 u = any_across(c.axis), v = cross(c.axis, u);
  std::array<std::array<double, 5>, 5> A{};
  std::array<double, 5> b{};
  for (const auto& t : surface.triangles) {
    const Vec3 &p = surface.points[t[0]], &q = surface.points[t[1]], &r = surface.points[t[2]];
    const Vec3 x = (1.0 / 3) * (p + q + r) - c.centre, area = 0.5 * cross(q - p, r - p);
    const double s = dot(x, c.axis), weight = norm(area);
    if (s < from || s > to || std::abs(dot(area, c.axis)) > 0.7 * weight) continue;  // an end, not the wall
    const Vec3 across = x - s * c.axis;
    const double d = norm(across), nu = dot(across, u) / d, nv = dot(across, v) / d;
    const std::array<double, 5> slope{-nu, -nv, -s * nu, -s * nv, -1};  // of d − r by centre along u, v, axis towards u, v, radius
    for (int i = 0; i < 5; ++i) {
      b[i] -= weight * slope[i] * (d - c.radius);
      for (int j = 0; j < 5; ++j) A[i][j] += weight * slope[i] * slope[j];
    }
  }
  if (!solve<5>(A, b)) throw Failure(ExitCode::not_converged, "no cylinder fits this surface", "", "--shape tube for a bent one");
  c.centre = c.centre + b[0] * u + b[1] * v;
  c.axis = unit(c.axis + b[2] * u + b[3] * v);
  c.radius += b[4];
  return std::abs(b[0]) + std::abs(b[1]) + c.length * (std::abs(b[2]) + std::abs(b[3])) + std::abs(b[4]);
}

}  // namespace

Surface make_tube(const std::vector<Vec3>& axis, double radius, double edge) {
  const int corners = std::max(6, static_cast<int>(std::lround(2 * std::numbers::pi * radius / edge)));
  const auto line = even(axis, edge * std::sqrt(3) / 2);
  Surface s;
  s.region_names = {{wall_region, "wall"}, {2, "end_1"}, {3, "end_2"}};
  Vec3 t = unit(line[1] - line[0]), u = any_across(t);
  for (std::size_t i = 0; i < line.size(); ++i) {
    t = unit(line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1]);
    u = unit(u - dot(u, t) * t);
    const Vec3 v = cross(t, u);
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5 * (i % 2)) / corners;
      s.points.push_back(line[i] + radius * std::cos(angle) * u + radius * std::sin(angle) * v);
    }
  }
  for (int i = 0; i + 1 < line.size(); ++i)
    for (int k = 0; k < corners; ++k) {
      const int l = (k + 1) % corners, a = i * corners, b = a + corners;
      if (i % 2 == 0) {
        add_triangle(s, a + k, a + l, b + k, wall_region);
        add_triangle(s, a + l, b + l, b + k, wall_region);
      } else {
        add_triangle(s, a + k, a + l, b + l, wall_region);
        add_triangle(s, a + k, b + l, b + k, wall_region);
      }
    }
  add_end(s, 0, corners, line.front(), radius, edge, 2, false);
  add_end(s, static_cast<int>(line.size() - 1) * corners, corners, line.back(), radius, edge, 3, true);
  return s;
}

Cylinder fit_cylinder(const Surface& surface, const CentreLine& line) {
  Cylinder c;
  c.centre = line.at(line.length() / 2);
  c.axis = unit(line.at(0.9 * line.length()) - line.at(0.1 * line.length()));
  c.radius = line.diameter[line.diameter.size() / 2] / 2;
  double move = 1, from = 0, to = 0;
  for (int step = 0; step < 100 && move > 1e-9 * c.radius; ++step) {
    from = std::numeric_limits<double>::infinity(), to = -from;
    for (const Vec3& x : surface.points) {
      const double s = dot(x - c.centre, c.axis);
      from = std::min(from, s), to = std::max(to, s);
    }
    c.length = to - from;
    move = improve(c, surface, from + 0.05 * c.length, to - 0.05 * c.length);
  }
  if (!(move <= 1e-6 * c.radius)) throw Failure(ExitCode::not_converged, "no cylinder fits this surface", "", "--shape tube for a bent one");
  c.centre = c.centre + (from + to) / 2 * c.axis;
  return c;
}

Difference difference(const Surface& one, const Surface& other) {
  Difference d{0, 0, enclosed_volume(one), enclosed_volume(other), {}};
  double sum = 0, area = 0;
  for (const auto& [from, to] : {std::pair{&one, &other}, std::pair{&other, &one}}) {
    const SurfaceIndex index(*to);
    const auto look = [&](const Vec3& x) {
      const double distance = index.nearest(x).distance;
      if (distance > d.hausdorff_mm) d.hausdorff_mm = distance, d.worst_at = x;
      return distance;
    };
    for (const Vec3& x : from->points) look(x);
    for (const auto& t : from->triangles) {
      const Vec3 &a = from->points[t[0]], &b = from->points[t[1]], &c = from->points[t[2]];
      const double weight = norm(cross(b - a, c - a)) / 2, distance = look((1.0 / 3) * (a + b + c));
      sum += weight * distance * distance;
      area += weight;
    }
  }
  d.rms_mm = std::sqrt(sum / area);
  return d;
}

}  // namespace palpate
