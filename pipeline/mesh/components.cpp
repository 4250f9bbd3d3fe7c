// Shells by union of triangles across edges; nesting by the solid-angle formula of van Oosterom & Strackee (1983).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/components.hpp>

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

/// An edge as a triangle sees it: the ends in order, whether this is the triangle's direction, and the triangle.
struct EdgeUse {
  int low, high;
  bool forward;
  int triangle;
  bool operator<(const EdgeUse& o) const { return std::tie(low, high, forward, triangle) < std::tie(o.low, o.high, o.forward, o.triangle); }
};

std::vector<EdgeUse> sorted_edges(const Surface& surface) {
  std::vector<EdgeUse> edges;
  for (int t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = surface.triangles[t][k], b = surface.triangles[t][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b, t});
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

[[noreturn]] void bad_edge(const Surface& surface, const EdgeUse& edge, const std::string& what, const std::string& next) {
  const Vec3 middle = 0.5 * (surface.points[edge.low] + surface.points[edge.high]);
  throw Failure(ExitCode::check_failed, what, "triangle " + std::to_string(edge.triangle) + ", edge at " + place_text(middle), next);
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Root triangle of every triangle's shell; every edge is checked on the way.
std::vector<int> roots_of_shells(const Surface& surface) {
  std::vector<int> parent(surface.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto edges = sorted_edges(surface);
  for (std::size_t first = 0, last; first < edges.size(); first = last) {
    for (last = first; last < edges.size() && edges[last].low == edges[first].low && edges[last].high == edges[first].high; ++last) {}
    const std::string repair = "palpate-surface closes and repairs surfaces";
    if (last - first == 1) bad_edge(surface, edges[first], "the surface is open", repair);
    if (last - first > 2) bad_edge(surface, edges[first], std::to_string(last - first) + " triangles share one edge", repair);
    if (edges[first].forward == edges[first + 1].forward) bad_edge(surface, edges[first], "neighbouring triangles face opposite sides", repair);
    const int a = root_of(parent, edges[first].triangle), b = root_of(parent, edges[first + 1].triangle);
    parent[std::max(a, b)] = std::min(a, b);
  }
  for (int t = 0; t < parent.size(); ++t) parent[t] = root_of(parent, t);
  return parent;
}

int commonest_region(const Surface& surface, const std::vector<int>& triangles) {
  std::map<int, int> count;
  for (int t : triangles) ++count[surface.triangle_region[t]];
  return std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
}

/// Winding number of a shell around x: Σ solid angles / 4π; 1 inside, 0 outside, -1 inside a shell that faces inward.
double winding(const Surface& surface, const Shell& shell, const Vec3& x) {
  double angle = 0;
  for (int t : shell.triangles) {
    const auto& [i, j, k] = surface.triangles[t];
    const Vec3 a = surface.points[i] - x, b = surface.points[j] - x, c = surface.points[k] - x;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

Vec3 first_point(const Surface& surface, const Shell& shell) { return surface.points[surface.triangles[shell.triangles.front()][0]]; }

/// The smallest shell around each shell; -1 when there is none.
std::vector<int> parents_of(const Surface& surface, const std::vector<Shell>& shells) {
  std::vector<int> parents(shells.size(), -1);
  for (int i = 0; i < shells.size(); ++i)
    for (int j = 0; j < shells.size(); ++j) {
      if (i == j || std::abs(shells[j].volume) <= std::abs(shells[i].volume)) continue;
      if (std::abs(winding(surface, shells[j], first_point(surface, shells[i]))) < 0.5) continue;
      if (parents[i] < 0 || std::abs(shells[j].volume) < std::abs(shells[parents[i]].volume)) parents[i] = j;
    }
  return parents;
}

}  // namespace

std::string place_text(const Vec3& x) {
  std::ostringstream out;
  out.precision(6);
  out << "(" << x[0] << ", " << x[1] << ", " << x[2] << ") mm";
  return out.str();
}

double total_volume(const std::vector<Shell>& shells, const std::vector<Body>& bodies) {
  double volume = 0;
  for (const Body& body : bodies) {
    volume += shells[body.outer].volume;
    for (int hole : body.holes) volume -= std::abs(shells[hole].volume);
  }
  return volume;
}

double enclosed_volume(const Surface& surface, const std::vector<int>& triangles) {
  const Vec3 origin = surface.points[surface.triangles[triangles.front()][0]];  // near, so that digits are not lost
  double six_volumes = 0;
  for (int t : triangles) {
    const auto& [i, j, k] = surface.triangles[t];
    six_volumes += dot(surface.points[i] - origin, cross(surface.points[j] - origin, surface.points[k] - origin));
  }
  return six_volumes / 6;
}

double enclosed_volume(const Surface& surface) {
  std::vector<int> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return enclosed_volume(surface, all);
}

Surface without_unused_points(const Surface& surface) {
  std::vector<int> index(surface.points.size(), -1);
  for (const auto& t : surface.triangles)
    for (int i : t) index[i] = 0;
  Surface result = surface;
  result.points.clear();
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] < 0) continue;
    index[i] = static_cast<int>(result.points.size());
    result.points.push_back(surface.points[i]);
  }
  for (auto& t : result.triangles) t = {index[t[0]], index[t[1]], index[t[2]]};
  return result;
}

std::vector<Shell> closed_shells(const Surface& surface) {
  if (surface.triangles.empty()) throw Failure(ExitCode::check_failed, "the surface has no triangles", "", "see the stage that made it");
  const auto roots = roots_of_shells(surface);
  std::map<int, Shell> by_root;
  for (int t = 0; t < roots.size(); ++t) by_root[roots[t]].triangles.push_back(t);
  std::vector<Shell> shells;
  for (auto& [root, shell] : by_root) {
    shell.volume = enclosed_volume(surface, shell.triangles);
    shell.region = commonest_region(surface, shell.triangles);
    shells.push_back(std::move(shell));
  }
  return shells;
}

std::vector<Body> bodies_of(const Surface& surface, const std::vector<Shell>& shells) {
  const auto parents = parents_of(surface, shells);
  std::vector<Body> bodies;
  std::vector<int> body_of(shells.size(), -1);
  for (int i = 0; i < shells.size(); ++i)
    if (shells[i].volume > 0) {
      body_of[i] = static_cast<int>(bodies.size());
      bodies.push_back({i, {}, shells[i].region});
    }
  for (int i = 0; i < shells.size(); ++i) {
    const int around = parents[i];
    const bool in_solid = around >= 0 && shells[around].volume > 0;
    const std::string where = "shell " + std::to_string(i) + " of " + std::to_string(shells.size()) + " at " + place_text(first_point(surface, shells[i]));
    if (!in_solid && shells[i].volume <= 0)
      throw Failure(ExitCode::check_failed, "the surface is inside out: its triangles face inward", where, "turn them, or run palpate-surface");
    if (in_solid && shells[i].volume > 0 && shells[i].region == shells[around].region)
      throw Failure(ExitCode::check_failed, "a closed surface lies inside another of the same region, and both face outward", where,
                    "a cavity's triangles face inward; otherwise remove the inner surface");
    if (in_solid) bodies[body_of[around]].holes.push_back(i);
  }
  return bodies;
}

}  // namespace palpate
