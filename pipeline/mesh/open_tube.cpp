// Clipping triangles by a height over each plane, known at the points.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/open_tube.hpp>

#include <algorithm>
#include <map>

#include <palpate/errors.hpp>
#include <pipeline/mesh/size_field.hpp>

namespace palpate {
namespace {

Surface used_part(const Surface& surface) {
  Surface part;
  part.region_names = surface.region_names;
  part.triangle_region = surface.triangle_region;
  std::map<int, int> place;
  for (const auto& t : surface.triangles)
    for (int i : t) place[i] = 0;
  for (auto& [old, now] : place) {
    now = static_cast<int>(part.points.size());
    part.points.push_back(surface.points[old]);
  }
  for (const auto& t : surface.triangles) part.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return part;
}

/// Keeps where height ≤ 0. The new points lie on the edges the plane crosses.
Surface clipped(const Surface& surface, const std::vector<double>& height) {
  Surface kept;
  kept.points = surface.points;
  kept.region_names = surface.region_names;
  std::map<std::pair<int, int>, int> crossings;
  const auto crossing = [&](int a, int b) {
    const auto [entry, fresh] = crossings.try_emplace(std::minmax(a, b), static_cast<int>(kept.points.size()));
    if (fresh) kept.points.push_back(surface.points[a] + height[a] / (height[a] - height[b]) * (surface.points[b] - surface.points[a]));
    return entry->second;
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    std::vector<int> corners;
    for (int k = 0; k < 3; ++k) {
      const int a = surface.triangles[t][k], b = surface.triangles[t][(k + 1) % 3];
      if (height[a] <= 0) corners.push_back(a);
      if ((height[a] < 0 && height[b] > 0) || (height[a] > 0 && height[b] < 0)) corners.push_back(crossing(a, b));
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      kept.triangles.push_back({corners[0], corners[k - 1], corners[k]});
      kept.triangle_region.push_back(surface.triangle_region[t]);
    }
  }
  return kept;
}

/// A triangle with all corners on the plane belongs to neither side.
void drop_flat(Surface& surface) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    if (a == b || b == c || c == a) continue;
    surface.triangles[kept] = surface.triangles[t];
    surface.triangle_region[kept++] = surface.triangle_region[t];
  }
  surface.triangles.resize(kept);
  surface.triangle_region.resize(kept);
}

/// One cut: away with what lies on the normal's side. Far from the cut the arc length says on which side a point is.
Surface cut(Surface surface, const CentreLine& line, double s, double sign) {
  const Vec3 point = line.at(s), normal = sign * line.tangent(s);
  const double snap = mean_edge(surface) / 10;
  std::vector<double> height;
  for (Vec3& x : surface.points) {
    const double along = sign * (line.project(x) - s), across = dot(x - point, normal);
    const bool near = std::abs(across) < line.length() / 4 && norm(x - point) < line.length() / 3;
    height.push_back(near ? across : along);
    if (near && std::abs(across) < snap) x = x - across * normal, height.back() = 0;
  }
  Surface kept = clipped(surface, height);
  drop_flat(kept);
  if (kept.triangles.empty())
    throw Failure(ExitCode::misuse, "nothing is left between the two cuts", "", "the centre line is " + std::to_string(line.length()) + " mm long");
  return used_part(kept);
}

}  // namespace

Surface without_ends(const Surface& surface) {
  Surface open;
  open.points = surface.points;
  open.region_names = surface.region_names;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto name = surface.region_names.find(surface.triangle_region[t]);
    if (name != surface.region_names.end() && name->second.starts_with("end")) continue;
    open.triangles.push_back(surface.triangles[t]);
    open.triangle_region.push_back(surface.triangle_region[t]);
  }
  return used_part(open);
}

Surface moved_outward(const Surface& surface, double distance) {
  std::vector<Vec3> normal(surface.points.size(), Vec3{0, 0, 0});
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = surface.points[t[(k + 1) % 3]] - surface.points[t[k]], b = surface.points[t[(k + 2) % 3]] - surface.points[t[k]];
      const Vec3 n = cross(a, b);
      if (norm(n) > 0) normal[t[k]] = normal[t[k]] + (std::atan2(norm(n), dot(a, b)) / norm(n)) * n;
    }
  Surface moved = surface;
  for (std::size_t i = 0; i < moved.points.size(); ++i)
    if (norm(normal[i]) > 0) moved.points[i] = moved.points[i] + distance * unit(normal[i]);
  return moved;
}

Surface cut_between(const Surface& surface, const CentreLine& line, double from, double to) {
  return cut(cut(surface, line, from, -1), line, to, 1);
}

std::vector<std::vector<int>> rims(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::pair<int, int>, bool> directed;
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) directed[{t[k], t[(k + 1) % 3]}] = true;
  std::map<int, int> next;
  for (const auto& [edge, there] : directed)
    if (!directed.contains({edge.second, edge.first})) next[edge.first] = edge.second;
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      loops.back().push_back(at->first);
      const int following = at->second;
      next.erase(at);
      at = next.find(following);
    }
  }
  return loops;
}

}  // namespace palpate
