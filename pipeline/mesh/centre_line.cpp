// Distance along edges from one end of the tube; bands of equal distance; their centroids, smoothed.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/centre_line.hpp>

#include <algorithm>
#include <map>
#include <numbers>
#include <queue>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

using Graph = std::vector<std::vector<std::pair<int, double>>>;

Graph edges_of(const Surface& surface) {
  Graph graph(surface.points.size());
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      const double length = norm(surface.points[a] - surface.points[b]);
      graph[a].push_back({b, length});
      graph[b].push_back({a, length});
    }
  return graph;
}

/// Shortest way along edges from the sources (Dijkstra 1959); infinite where there is none.
std::vector<double> distances(const Graph& graph, const std::vector<int>& sources) {
  std::vector<double> distance(graph.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> front;
  for (int s : sources) front.push({distance[s] = 0, s});
  while (!front.empty()) {
    const auto [d, a] = front.top();
    front.pop();
    if (d > distance[a]) continue;
    for (const auto& [b, length] : graph[a])
      if (d + length < distance[b]) front.push({distance[b] = d + length, b});
  }
  return distance;
}

int farthest(const std::vector<double>& distance) {
  int best = 0;
  for (int i = 0; i < distance.size(); ++i)
    if (std::isfinite(distance[i]) && distance[i] > distance[best]) best = i;
  return best;
}

/// The rim that holds a point, or the point itself where the surface is closed there.
std::vector<int> rim_of(const Surface& surface, const Graph& graph, int point) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  Graph rims(graph.size());
  for (const auto& [edge, count] : uses)
    if (count == 1) {
      rims[edge.first].push_back({edge.second, 1});
      rims[edge.second].push_back({edge.first, 1});
    }
  int nearest = -1;
  const auto from_point = distances(graph, {point});
  for (int i = 0; i < rims.size(); ++i)
    if (!rims[i].empty() && (nearest < 0 || from_point[i] < from_point[nearest])) nearest = i;
  if (nearest < 0) return {point};
  std::vector<int> rim;
  const auto along = distances(rims, {nearest});
  for (int i = 0; i < along.size(); ++i)
    if (std::isfinite(along[i])) rim.push_back(i);
  return rim;
}

/// Area-weighted centroids of the bands.
std::vector<Vec3> bands(const Surface& surface, const std::vector<double>& distance, double step) {
  std::map<int, std::pair<Vec3, double>> sums;
  for (const auto& t : surface.triangles) {
    const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    const double area = norm(cross(b - a, c - a)) / 2;
    const double d = (distance[t[0]] + distance[t[1]] + distance[t[2]]) / 3;
    if (!std::isfinite(d)) continue;
    auto& [sum, weight] = sums.try_emplace(static_cast<int>(d / step), Vec3{}, 0.0).first->second;
    sum = sum + area / 3 * (a + b + c);
    weight += area;
  }
  std::vector<Vec3> centres;
  for (const auto& [band, sum] : sums)
    if (sum.second > 0) centres.push_back(1 / sum.second * sum.first);
  return centres;
}

void smooth(std::vector<Vec3>& line, int passes) {
  for (int pass = 0; pass < passes; ++pass) {
    const auto before = line;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) line[i] = 0.25 * before[i - 1] + 0.5 * before[i] + 0.25 * before[i + 1];
  }
}

/// The points of a line that lie this far from the last one kept: a flat end is one point.
std::vector<Vec3> apart(const std::vector<Vec3>& line, double distance) {
  std::vector<Vec3> kept{line.front()};
  for (const Vec3& x : line)
    if (norm(x - kept.back()) >= distance) kept.push_back(x);
  return kept;
}

std::size_t segment_of(const CentreLine& line, double s) {
  const auto after = std::upper_bound(line.arc.begin(), line.arc.end(), s) - line.arc.begin();
  return std::clamp<std::ptrdiff_t>(after, 1, line.arc.size() - 1) - 1;
}

}  // namespace

Vec3 CentreLine::at(double s) const {
  const std::size_t i = segment_of(*this, s);
  return points[i] + (s - arc[i]) / (arc[i + 1] - arc[i]) * (points[i + 1] - points[i]);
}

Vec3 CentreLine::tangent(double s) const {
  const double reach = length() / 20;
  return unit(at(s + reach) - at(s - reach));
}

double CentreLine::project(const Vec3& x) const {
  double best = std::numeric_limits<double>::infinity(), s = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 edge = points[i + 1] - points[i];
    double t = dot(x - points[i], edge) / dot(edge, edge);
    if (i > 0) t = std::max(t, 0.0);
    if (i + 2 < points.size()) t = std::min(t, 1.0);
    const double d = norm(x - points[i] - t * edge);
    if (d < best) best = d, s = arc[i] + t * norm(edge);
  }
  return s;
}

double section_area(const Surface& surface, const Vec3& point, const Vec3& normal, double reach) {
  double twice = 0;
  for (const auto& t : surface.triangles) {
    std::array<Vec3, 2> ends;
    int found = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = surface.points[t[k]], &b = surface.points[t[(k + 1) % 3]];
      const double ha = dot(a - point, normal), hb = dot(b - point, normal);
      if ((ha < 0) == (hb < 0) || norm(a - point) > reach) continue;
      // from below to above or back: the sense in which the contour runs
      ends[ha < 0 ? 0 : 1] = a + ha / (ha - hb) * (b - a) - point;
      ++found;
    }
    if (found == 2) twice += dot(cross(ends[0], ends[1]), normal);
  }
  return std::abs(twice) / 2;
}

CentreLine centre_line(const Surface& surface, double step) {
  const Graph graph = edges_of(surface);
  const int first = surface.triangles.front()[0];
  const int tip = farthest(distances(graph, {first}));
  const auto distance = distances(graph, rim_of(surface, graph, tip));
  CentreLine line;
  line.points = bands(surface, distance, step);
  smooth(line.points, 4);
  line.points = apart(line.points, step / 2);
  if (line.points.size() < 4)
    throw Failure(ExitCode::check_failed, "the surface is no longer than it is wide: it has no centre line", "", "a tube, cut at both ends");
  for (std::size_t i = 0; i < line.points.size(); ++i)
    line.arc.push_back(i == 0 ? 0 : line.arc.back() + norm(line.points[i] - line.points[i - 1]));
  for (double s : line.arc)
    line.diameter.push_back(2 * std::sqrt(section_area(surface, line.at(s), line.tangent(s), line.length() / 2) / std::numbers::pi));
  return line;
}

}  // namespace palpate
