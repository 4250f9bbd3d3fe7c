// Signed distance to a closed triangle surface: to its nearest point, with the sign of the angle-weighted pseudonormal there
// (Bærentzen, Aanæs 2005, IEEE Trans. Vis. Comput. Graph. 11:243).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include <solver/contact/tool.hpp>
#include <solver/contact/triangle_tree.hpp>

namespace palpate::contact {

/// Closed, two triangles at every edge, one fan at every corner, facing outward; that it does not cut itself is not checked.
class ClosedSurface {
 public:
  /// Triangles counter-clockwise seen from outside. Throws Failure(unreadable) with `file` and the place in mm otherwise.
  ClosedSurface(std::vector<Eigen::Vector3d> points, std::vector<std::array<int, 3>> triangles, const std::string& file);

  /// Negative inside. Hessian: 0 above faces, (I − n nᵀ − t tᵀ)/g along edges of direction t, (I − n nᵀ)/g around corners.
  tools::Distance distance(const Eigen::Vector3d& x) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<Eigen::Vector3d> face_normals_;    ///< unit
  std::vector<Eigen::Vector3d> corner_normals_;  ///< one per point: Σ angle · face normal, not unit
  std::vector<std::array<Eigen::Vector3d, 3>> edge_normals_;  ///< per triangle: sums of the two face normals, not unit
  TriangleTree tree_;
};

}  // namespace palpate::contact
