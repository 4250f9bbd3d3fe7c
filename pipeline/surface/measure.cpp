// Measures and faults of a triangle surface, from its triangles alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/surface/measure.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <span>

namespace palpate {
namespace {

constexpr double deg = 180 / std::numbers::pi;

/// Six times the signed volume of the tetrahedron from `base`.
double six_volume(const Surface& s, const std::array<int, 3>& t, const Vec3& base) {
  return dot(s.points[t[0]] - base, cross(s.points[t[1]] - base, s.points[t[2]] - base));
}

Vec3 double_area(const Surface& s, const std::array<int, 3>& t) {
  return cross(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]);
}

/// One side of an edge: the triangle runs from `from` to `to`.
struct Side {
  int low, high, triangle;
  bool forward;  ///< runs low → high
};

/// All sides, those of one edge together, in a fixed order.
std::vector<Side> sorted_sides(const Surface& s) {
  std::vector<Side> sides;
  sides.reserve(3 * s.triangles.size());
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (int e = 0; e < 3; ++e) {
      const int from = s.triangles[t][e], to = s.triangles[t][(e + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), int(t), from < to});
    }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& a, const Side& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  return sides;
}

/// Calls visit(the sides of one edge) for each edge.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, Visit visit) {
  const auto differs = [](const Side& a, const Side& b) { return a.low != b.low || a.high != b.high; };
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const Side& side) { return differs(*first, side); });
    visit(std::span<const Side>(first, last));
    first = last;
  }
}

/// Smallest and largest angle of a triangle.
std::pair<double, double> extreme_angles(const Surface& s, const std::array<int, 3>& t) {
  std::pair<double, double> extreme{180, 0};
  for (int c = 0; c < 3; ++c) {
    const Vec3& x = s.points[t[c]];
    const Vec3 u = s.points[t[(c + 1) % 3]] - x, v = s.points[t[(c + 2) % 3]] - x;
    const double angle = deg * std::atan2(norm(cross(u, v)), dot(u, v));
    extreme = {std::min(extreme.first, angle), std::max(extreme.second, angle)};
  }
  return extreme;
}

/// Angle between the two triangles of an edge: 180 is flat.
double fold_deg_of(const Surface& s, std::span<const Side> edge) {
  const Vec3 m = double_area(s, s.triangles[edge[0].triangle]), n = double_area(s, s.triangles[edge[1].triangle]);
  return 180 - deg * std::atan2(norm(cross(m, n)), dot(m, n));
}

class Union {
 public:
  explicit Union(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

/// A point is pinched when its triangles form more than one fan joined over edges.
void find_pinched(const Surface& s, const std::vector<Side>& sides, Faults& faults) {
  Union fans(3 * s.triangles.size());  // corners of triangles
  const auto corner = [&](int triangle, int point) {
    const auto& t = s.triangles[triangle];
    return 3 * triangle + int(std::find(t.begin(), t.end(), point) - t.begin());
  };
  for_each_edge(sides, [&](std::span<const Side> edge) {
    for (const Side& side : edge)
      for (int point : {side.low, side.high}) fans.join(corner(edge[0].triangle, point), corner(side.triangle, point));
  });
  std::vector<int> fan_of(s.points.size(), -1);
  std::vector<bool> counted(s.points.size(), false);
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const int point = s.triangles[t][c], fan = fans.find(3 * int(t) + c);
      if (fan_of[point] < 0) fan_of[point] = fan;
      if (fan_of[point] == fan || counted[point]) continue;
      counted[point] = true;
      if (faults.pinched_points++ == 0) faults.pinched_at = s.points[point];
    }
}

}  // namespace

double volume_mm3(const Surface& surface) {
  double sum = 0;
  for (const auto& t : surface.triangles) sum += six_volume(surface, t, surface.points.front());
  return sum / 6;
}

double area_mm2(const Surface& surface) {
  double sum = 0;
  for (const auto& t : surface.triangles) sum += norm(double_area(surface, t));
  return sum / 2;
}

Angles angles(const Surface& surface) {
  Angles result;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [smallest, largest] = extreme_angles(surface, surface.triangles[t]);
    result.max_deg = std::max(result.max_deg, largest);
    if (smallest < result.min_deg) result.min_deg = smallest, result.sharpest_triangle = int(t);
  }
  for_each_edge(sorted_sides(surface), [&](std::span<const Side> edge) {
    const double fold = edge.size() == 2 ? fold_deg_of(surface, edge) : 180;
    if (fold < result.min_fold_deg) result.min_fold_deg = fold, result.fold_triangle = edge[0].triangle;
  });
  return result;
}

std::vector<int> poor_triangles(const Surface& surface, double deg_limit, double fold_deg) {
  std::vector<bool> poor(surface.triangles.size(), false);
  for (std::size_t t = 0; t < poor.size(); ++t) poor[t] = extreme_angles(surface, surface.triangles[t]).first < deg_limit;
  for_each_edge(sorted_sides(surface), [&](std::span<const Side> edge) {
    if (edge.size() == 2 && fold_deg_of(surface, edge) < fold_deg) poor[edge[0].triangle] = poor[edge[1].triangle] = true;
  });
  std::vector<int> list;
  for (std::size_t t = 0; t < poor.size(); ++t)
    if (poor[t]) list.push_back(int(t));
  return list;
}

std::vector<Shell> shells(const Surface& surface) {
  const auto sides = sorted_sides(surface);
  Union joined(surface.triangles.size());
  for_each_edge(sides, [&](std::span<const Side> edge) {
    for (const Side& side : edge) joined.join(edge[0].triangle, side.triangle);
  });
  std::vector<int> shell_of(surface.triangles.size(), -1);
  std::vector<Shell> all;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const int root = joined.find(int(t));
    if (shell_of[root] < 0) shell_of[root] = int(all.size()), all.emplace_back();
    shell_of[t] = shell_of[root];
    Shell& shell = all[shell_of[t]];
    shell.triangles.push_back(int(t));
    shell.volume_mm3 += six_volume(surface, surface.triangles[t], surface.points.front()) / 6;
    shell.area_mm2 += norm(double_area(surface, surface.triangles[t])) / 2;
  }
  std::vector<int> edges(all.size(), 0), points(all.size(), 0);
  for_each_edge(sides, [&](std::span<const Side> edge) { ++edges[shell_of[edge[0].triangle]]; });
  std::vector<int> seen(surface.points.size(), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int point : surface.triangles[t])
      if (seen[point] != shell_of[t]) seen[point] = shell_of[t], ++points[shell_of[t]];
  for (std::size_t i = 0; i < all.size(); ++i) all[i].genus = (2 - (points[i] - edges[i] + int(all[i].triangles.size()))) / 2;
  std::stable_sort(all.begin(), all.end(), [](const Shell& a, const Shell& b) { return a.volume_mm3 > b.volume_mm3; });
  return all;
}

Surface part_of(const Surface& surface, const std::vector<bool>& kept_triangles) {
  Surface part;
  part.region_names = surface.region_names;
  std::vector<int> index(surface.points.size(), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (kept_triangles[t])
      for (int p : surface.triangles[t]) index[p] = 0;
  for (std::size_t p = 0; p < index.size(); ++p)
    if (index[p] == 0) index[p] = int(part.points.size()), part.points.push_back(surface.points[p]);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!kept_triangles[t]) continue;
    const auto& [a, b, c] = surface.triangles[t];
    part.triangles.push_back({index[a], index[b], index[c]});
    part.triangle_region.push_back(surface.triangle_region[t]);
  }
  return part;
}

Faults faults(const Surface& surface) {
  Faults result;
  const auto sides = sorted_sides(surface);
  const auto note = [&](int& count, Vec3& at, const Side& side) {
    if (count++ == 0) at = 0.5 * (surface.points[side.low] + surface.points[side.high]);
  };
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() == 1)
      note(result.open_edges, result.open_at, edge[0]);
    else if (edge.size() > 2)
      note(result.crowded_edges, result.crowded_at, edge[0]);
    else if (edge[0].forward == edge[1].forward)
      note(result.twisted_edges, result.twisted_at, edge[0]);
  });
  find_pinched(surface, sides, result);
  return result;
}

std::string place_text(const Vec3& x) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.2f, %.2f, %.2f) mm", x[0], x[1], x[2]);
  return text;
}

std::string place_of_triangle(const Surface& surface, int triangle) {
  if (triangle < 0) return "";
  const auto& t = surface.triangles[triangle];
  return "triangle " + std::to_string(triangle) + " at " +
         place_text((1.0 / 3) * (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]));
}

}  // namespace palpate
