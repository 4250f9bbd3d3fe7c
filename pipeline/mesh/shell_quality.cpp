// Angles and medians of triangles.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/shell_quality.hpp>

#include <algorithm>
#include <numbers>
#include <numeric>

namespace palpate {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), dot(a, b)) * degrees; }

TriangleShape shape_of(const ShellMesh& mesh, int t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return triangle_shape(mesh.points[a], mesh.points[b], mesh.points[c]);
}

}  // namespace

TriangleShape triangle_shape(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<Vec3, 3> x{a, b, c};
  TriangleShape shape;
  shape.shortest_edge = std::numeric_limits<double>::infinity();
  double sharpest = 180, widest = 0, crossing = 90;
  for (int k = 0; k < 3; ++k) {
    const Vec3 &p = x[k], &q = x[(k + 1) % 3], &r = x[(k + 2) % 3];
    const double edge = norm(q - p), angle = angle_between(q - p, r - p);
    shape.longest_edge = std::max(shape.longest_edge, edge);
    shape.shortest_edge = std::min(shape.shortest_edge, edge);
    sharpest = std::min(sharpest, angle);
    widest = std::max(widest, angle);
    const Vec3 median = 0.5 * (q + r) - p, middle = 0.5 * (r - q);  // the mid-points of pq and pr lie half of qr apart
    const double between = angle_between(median, middle);
    crossing = std::min(crossing, std::min(between, 180 - between));
  }
  shape.skew_deg = 90 - crossing;
  shape.equiangular_skew = std::max((widest - 60) / 120, (60 - sharpest) / 60);
  return shape;
}

ShellQuality shell_quality(const ShellMesh& mesh) {
  ShellQuality quality;
  quality.worst.shortest_edge = std::numeric_limits<double>::infinity();
  std::vector<double> skew;
  for (int t = 0; t < mesh.triangles.size(); ++t) {
    const TriangleShape s = shape_of(mesh, t);
    auto& worst = quality.worst;
    worst.longest_edge = std::max(worst.longest_edge, s.longest_edge);
    worst.shortest_edge = std::min(worst.shortest_edge, s.shortest_edge);
    worst.skew_deg = std::max(worst.skew_deg, s.skew_deg);
    worst.equiangular_skew = std::max(worst.equiangular_skew, s.equiangular_skew);
    worst.jacobian = std::min(worst.jacobian, s.jacobian);
    skew.push_back(s.equiangular_skew);
    const auto& [a, b, c] = mesh.triangles[t];
    quality.area_mm2 += norm(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])) / 2;
    quality.mean_edge += (norm(mesh.points[b] - mesh.points[a]) + norm(mesh.points[c] - mesh.points[b]) + norm(mesh.points[a] - mesh.points[c])) / 3;
  }
  quality.mean_edge /= mesh.triangles.size();
  std::vector<int> order(skew.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return skew[a] > skew[b]; });
  order.resize(std::min<std::size_t>(order.size(), 10));
  quality.worst_ten = order;
  return quality;
}

Json to_json(const ShellMesh& mesh, const ShellQuality& quality) {
  const auto json = [](const TriangleShape& s) {
    return Json{{"longest_edge_mm", s.longest_edge}, {"shortest_edge_mm", s.shortest_edge}, {"skew_deg", s.skew_deg},
                {"equiangular_skew", s.equiangular_skew}, {"jacobian", s.jacobian}};
  };
  Json ten = Json::array();
  for (int t : quality.worst_ten) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 x = (1.0 / 3) * (mesh.points[a] + mesh.points[b] + mesh.points[c]);
    ten.push_back(json(shape_of(mesh, t)));
    ten.back()["triangle"] = t;
    ten.back()["at_mm"] = {x[0], x[1], x[2]};
  }
  return {{"worst", json(quality.worst)}, {"worst_ten", ten}, {"area_mm2", quality.area_mm2}, {"mean_edge_mm", quality.mean_edge}};
}

}  // namespace palpate
