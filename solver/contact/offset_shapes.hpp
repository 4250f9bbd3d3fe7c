// Distances of offset bodies: the distance to a core (point, half-line, solid of revolution) minus a radius.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/contact/tool.hpp>

namespace palpate::tools {

/// g = |v| − r with v the vector from a core point to x: n = v/|v|, Hessian (I − n nᵀ)/|v|.
inline Distance from_core_point(const Eigen::Vector3d& v, double r) {
  const double length = v.norm();
  if (!(length > 1e-12)) return {-r, -Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero()};
  const Eigen::Vector3d n = v / length;
  return {length - r, n, (Eigen::Matrix3d::Identity() - n * n.transpose()) / length};
}

/// As above for a core that is straight along z: v has no z, and the Hessian acts in the xy-plane alone.
inline Distance from_core_line(const Eigen::Vector3d& x, double r) {
  const Eigen::Vector3d radial(x.x(), x.y(), 0);
  Distance d = from_core_point(radial, r);
  d.hessian.row(2).setZero();
  d.hessian.col(2).setZero();
  return d;
}

}  // namespace palpate::tools
