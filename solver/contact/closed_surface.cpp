// Pseudonormals (Bærentzen, Aanæs 2005, section 3): face n; edge n₁ + n₂; corner Σ αᵢ nᵢ with the angles αᵢ of its triangles.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/closed_surface.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate::contact {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;
using Triangles = std::vector<std::array<int, 3>>;
using DirectedEdges = std::map<std::pair<int, int>, int>;  ///< from point to point: the triangle it belongs to

[[noreturn]] void refuse(const std::string& what, const std::string& file, const Vector3d& at, const std::string& next) {
  std::ostringstream where;
  where << file << " at (" << at.x() << ", " << at.y() << ", " << at.z() << ") mm";
  throw Failure(ExitCode::unreadable, what, where.str(), next);
}

void expect_area(const Points& points, const Triangles& triangles, const std::string& file) {
  if (triangles.empty()) throw Failure(ExitCode::unreadable, "the tool's surface has no triangles", file, "a closed triangle surface");
  for (const auto& t : triangles) {
    const Vector3d a = points[t[1]] - points[t[0]], b = points[t[2]] - points[t[0]];
    const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
    if (!(a.cross(b).norm() > 1e-9 * longest * longest))
      refuse("a triangle of the tool's surface has no area", file, points[t[0]], "remesh the surface");
  }
}

/// Every edge once in each direction.
DirectedEdges paired_edges(const Points& points, const Triangles& triangles, const std::string& file) {
  std::map<std::pair<int, int>, int> sides;
  DirectedEdges edges;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      ++sides[std::minmax(from, to)];
      edges.insert({{from, to}, t});
    }
  for (const auto& [edge, count] : sides) {
    const Vector3d at = (points[edge.first] + points[edge.second]) / 2;
    if (count == 1) refuse("the tool's surface is open: an edge has a triangle on one side alone", file, at, "close the hole");
    if (count > 2) refuse("the tool's surface is not a skin: " + std::to_string(count) + " triangles share an edge", file, at, "remove what is doubled");
    if (!edges.contains(edge) || !edges.contains({edge.second, edge.first}))
      refuse("the tool's surface has neighbouring triangles that face opposite ways", file, at, "orient its triangles alike");
  }
  return edges;
}

/// The triangles around each point are one fan: two skins that touch in a point have no outside there.
void expect_fans(const Points& points, const Triangles& triangles, const DirectedEdges& edges, const std::string& file) {
  std::vector<int> count(points.size(), 0), start(points.size(), -1);
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int point : triangles[t]) {
      ++count[point];
      start[point] = t;
    }
  for (int point = 0; point < static_cast<int>(points.size()); ++point) {
    int t = start[point], met = 0;
    if (t < 0) continue;
    do {
      int k = 0;
      while (triangles[t][k] != point) ++k;
      t = edges.at({point, triangles[t][(k + 2) % 3]});  // across the edge that arrives at the point
      ++met;
    } while (t != start[point]);
    if (met != count[point]) refuse("the tool's surface is not a skin: parts of it touch in a point", file, points[point], "separate them");
  }
}

void expect_outward(const Points& points, const Triangles& triangles, const std::string& file) {
  double volume = 0;  // six times, seen from one of its points
  const Vector3d& from = points[triangles[0][0]];
  for (const auto& t : triangles) volume += (points[t[0]] - from).dot((points[t[1]] - from).cross(points[t[2]] - from));
  if (!(volume > 0)) refuse("the tool's surface is inside out", file, from, "turn its triangles round");
}

}  // namespace

ClosedSurface::ClosedSurface(Points points, Triangles triangles, const std::string& file)
    : points_(std::move(points)), triangles_(std::move(triangles)), corner_normals_(points_.size(), Vector3d::Zero()) {
  expect_area(points_, triangles_, file);
  const DirectedEdges edges = paired_edges(points_, triangles_, file);
  expect_fans(points_, triangles_, edges, file);
  expect_outward(points_, triangles_, file);
  std::vector<std::array<Vector3d, 3>> corners;
  for (const auto& t : triangles_) {
    corners.push_back({points_[t[0]], points_[t[1]], points_[t[2]]});
    const Vector3d normal = (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).normalized();
    face_normals_.push_back(normal);
    for (int k = 0; k < 3; ++k) {
      const Vector3d a = points_[t[(k + 1) % 3]] - points_[t[k]], b = points_[t[(k + 2) % 3]] - points_[t[k]];
      corner_normals_[t[k]] += std::atan2(a.cross(b).norm(), a.dot(b)) * normal;
    }
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& t = triangles_[i];
    edge_normals_.emplace_back();
    for (int k = 0; k < 3; ++k) edge_normals_[i][k] = face_normals_[i] + face_normals_[edges.at({t[(k + 1) % 3], t[k]})];
  }
  tree_ = TriangleTree(std::move(corners));
}

tools::Distance ClosedSurface::distance(const Vector3d& x) const {
  using On = NearestPoint::On;
  const NearestPoint nearest = tree_.nearest(x);
  const auto& t = triangles_[nearest.triangle];
  if (nearest.on == On::face) {
    const Vector3d& n = face_normals_[nearest.triangle];
    return {n.dot(x - points_[t[0]]), n, Eigen::Matrix3d::Zero()};
  }
  const Vector3d& pseudonormal = nearest.on == On::edge ? edge_normals_[nearest.triangle][nearest.k] : corner_normals_[t[nearest.k]];
  const Vector3d away = x - nearest.point;
  const double g = std::copysign(away.norm(), away.dot(pseudonormal));
  if (!(std::abs(g) > 1e-12)) return {0, pseudonormal.normalized(), Eigen::Matrix3d::Zero()};
  const Vector3d n = away / g;
  Eigen::Matrix3d hessian = (Eigen::Matrix3d::Identity() - n * n.transpose()) / g;
  if (nearest.on == On::edge) {
    const Vector3d along = (points_[t[(nearest.k + 1) % 3]] - points_[t[nearest.k]]).normalized();
    hessian -= along * along.transpose() / g;
  }
  return {g, n, hessian};
}

}  // namespace palpate::contact
