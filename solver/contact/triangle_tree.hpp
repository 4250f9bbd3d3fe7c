// The nearest point of a set of triangles, by a tree of boxes around them, and what it lies on: a corner, an edge or a face.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <vector>

namespace palpate::contact {

struct NearestPoint {
  enum class On { corner, edge, face };
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double squared_distance = std::numeric_limits<double>::infinity();  ///< mm²
  int triangle = -1;
  On on = On::face;
  int k = 0;  ///< corner k, or the edge from corner k to the next; 0 for the face
};

/// Nearest point of one triangle of positive area.
NearestPoint nearest_on_triangle(const Eigen::Vector3d& x, const std::array<Eigen::Vector3d, 3>& corners);

/// Halves the triangles by their middles along the longest side, again and again; equal middles by their numbers.
class TriangleTree {
 public:
  TriangleTree() = default;
  explicit TriangleTree(std::vector<std::array<Eigen::Vector3d, 3>> triangles);

  /// Requires at least one triangle.
  NearestPoint nearest(const Eigen::Vector3d& x) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int begin = 0, end = 0;      ///< of order_
    int left = -1, right = -1;   ///< −1: a leaf
  };
  int build(int begin, int end);

  std::vector<std::array<Eigen::Vector3d, 3>> triangles_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace palpate::contact
