// The nearest point of a set of triangles, by a tree of boxes around them, and what it lies on: a corner, an edge or a face; and where a
// line meets them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <array>
#include <functional>
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

/// Where a line x + s d meets a triangle.
struct Crossing {
  double s = std::numeric_limits<double>::infinity();
  int triangle = -1;
  std::array<double, 3> weights{};  ///< of the triangle's corners
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

  /// The first crossing of x + s d, 0 ≤ s ≤ reach, that `counts`; triangle −1 when there is none. Edges belong to both of their triangles.
  template <class Counts>
  Crossing first_crossing(const Eigen::Vector3d& x, const Eigen::Vector3d& d, double reach, const Counts& counts) const {
    Crossing first;
    first.s = reach;
    visit_line(x, d, first.s, [&](int triangle) {
      const Crossing crossing = crossing_of(x, d, triangle);
      if (crossing.triangle >= 0 && (crossing.s < first.s || (crossing.s == first.s && first.triangle < 0)) && counts(crossing)) first = crossing;
    });
    return first;
  }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int begin = 0, end = 0;      ///< of order_
    int left = -1, right = -1;   ///< −1: a leaf
  };
  int build(int begin, int end);
  Crossing crossing_of(const Eigen::Vector3d& x, const Eigen::Vector3d& d, int triangle) const;
  /// Triangles of the boxes that the line meets within [0, reach]; `reach` may shrink meanwhile.
  void visit_line(const Eigen::Vector3d& x, const Eigen::Vector3d& d, const double& reach, const std::function<void(int)>& visit) const;

  std::vector<std::array<Eigen::Vector3d, 3>> triangles_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace palpate::contact
