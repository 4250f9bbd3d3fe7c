// Branch and bound: a box farther away than the nearest point so far holds nothing nearer.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/triangle_tree.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palpate::contact {

using Eigen::Vector3d;

namespace {

constexpr int leaf_size = 4;

Vector3d middle(const std::array<Vector3d, 3>& t) { return (t[0] + t[1] + t[2]) / 3; }

}  // namespace

NearestPoint nearest_on_triangle(const Vector3d& x, const std::array<Vector3d, 3>& corners) {
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  NearestPoint best;
  bool above_face = true;
  for (int k = 0; k < 3; ++k) {
    const Vector3d edge = corners[(k + 1) % 3] - corners[k], v = x - corners[k];
    if (normal.cross(edge).dot(v) >= 0) continue;
    above_face = false;
    const double s = std::clamp(v.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const Vector3d point = s < 1 ? Vector3d(corners[k] + s * edge) : corners[(k + 1) % 3];
    const double squared = (x - point).squaredNorm();
    if (!(squared < best.squared_distance)) continue;
    const bool on_corner = s == 0 || s == 1;
    best = {point, squared, -1, on_corner ? NearestPoint::On::corner : NearestPoint::On::edge, s == 1 ? (k + 1) % 3 : k};
  }
  if (!above_face) return best;
  const double height = normal.dot(x - corners[0]);
  return {x - height * normal, height * height, -1, NearestPoint::On::face, 0};
}

TriangleTree::TriangleTree(std::vector<std::array<Vector3d, 3>> triangles) : triangles_(std::move(triangles)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()));
}

int TriangleTree::build(int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({{}, begin, end, -1, -1});
  Eigen::AlignedBox3d box, middles;
  for (int i = begin; i < end; ++i) {
    for (const auto& corner : triangles_[order_[i]]) box.extend(corner);
    middles.extend(middle(triangles_[order_[i]]));
  }
  nodes_[index].box = box;
  if (end - begin <= leaf_size) return index;
  int axis = 0;
  middles.sizes().maxCoeff(&axis);
  const int half = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end, [&](int a, int b) {
    return std::pair(middle(triangles_[a])(axis), a) < std::pair(middle(triangles_[b])(axis), b);
  });
  const int left = build(begin, half), right = build(half, end);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

NearestPoint TriangleTree::nearest(const Vector3d& x) const {
  NearestPoint best;
  std::vector<std::pair<double, int>> open = {{nodes_[0].box.squaredExteriorDistance(x), 0}};
  while (!open.empty()) {
    const auto [distance, index] = open.back();
    open.pop_back();
    if (distance >= best.squared_distance) continue;
    const Node& node = nodes_[index];
    if (node.left < 0) {
      for (int i = node.begin; i < node.end; ++i) {
        NearestPoint candidate = nearest_on_triangle(x, triangles_[order_[i]]);
        candidate.triangle = order_[i];
        if (candidate.squared_distance < best.squared_distance) best = candidate;
      }
      continue;
    }
    std::pair<double, int> far = {nodes_[node.left].box.squaredExteriorDistance(x), node.left};
    std::pair<double, int> near = {nodes_[node.right].box.squaredExteriorDistance(x), node.right};
    if (far.first < near.first) std::swap(far, near);
    open.push_back(far);
    open.push_back(near);
  }
  return best;
}

/// Möller and Trumbore 1997, J. Graphics Tools 2:21, with a margin so that no line slips through between two triangles.
Crossing TriangleTree::crossing_of(const Vector3d& x, const Vector3d& d, int triangle) const {
  constexpr double margin = 1e-10;
  const auto& c = triangles_[triangle];
  const Vector3d e1 = c[1] - c[0], e2 = c[2] - c[0], p = d.cross(e2), from = x - c[0], q = from.cross(e1);
  const double det = e1.dot(p);
  if (det == 0) return {};
  const double u = from.dot(p) / det, v = d.dot(q) / det, s = e2.dot(q) / det;
  if (!(u >= -margin && v >= -margin && u + v <= 1 + margin && s >= 0)) return {};
  return {s, triangle, {1 - u - v, u, v}};
}

void TriangleTree::visit_line(const Vector3d& x, const Vector3d& d, const double& reach, const std::function<void(int)>& visit) const {
  if (nodes_.empty()) return;
  const auto meets = [&](const Eigen::AlignedBox3d& box) {
    double enter = 0, leave = reach;
    for (int k = 0; k < 3; ++k) {
      if (std::abs(d(k)) < 1e-300) {
        if (x(k) < box.min()(k) || x(k) > box.max()(k)) return false;
        continue;
      }
      const double a = (box.min()(k) - x(k)) / d(k), b = (box.max()(k) - x(k)) / d(k);
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave + 1e-12 * std::abs(leave);
  };
  std::vector<int> open = {0};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (!meets(node.box)) continue;
    if (node.left < 0) {
      for (int i = node.begin; i < node.end; ++i) visit(order_[i]);
    } else {
      open.push_back(node.right);
      open.push_back(node.left);
    }
  }
}

}  // namespace palpate::contact
