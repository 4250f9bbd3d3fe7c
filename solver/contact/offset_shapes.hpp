// Distances of offset bodies: the distance to a core (point, half-line, solid of revolution) minus a radius, so that every edge is round.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/contact/tool.hpp>

#include <cmath>

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

/// Distance in the half-plane (rho, s) of a solid of revolution, rho from the axis: gradient, and curvature of its level lines, 1/mm.
struct Meridian {
  double g = 0;
  double n_rho = 0, n_s = 0;
  double curvature = 0;
};

/// A right-angled corner rounded by r: `a` and `b` are the excesses beyond the core along s and along rho; inside, the nearer side counts.
inline Meridian rounded_corner(double a, double b, double r) {
  if (a > 0 && b > 0) {
    const double length = std::hypot(a, b);
    return {length - r, b / length, a / length, 1 / length};
  }
  return a > b ? Meridian{a - r, 0, 1, 0} : Meridian{b - r, 1, 0, 0};
}

/// The solid around `axis` (unit) through the origin: Hessian κ τ τᵀ + (n_rho/rho) φ φᵀ, τ in the half-plane and φ around the axis.
template <class HalfPlane>
Distance revolved(const Eigen::Vector3d& x, const Eigen::Vector3d& axis, HalfPlane half_plane) {
  const double s = x.dot(axis);
  const Eigen::Vector3d radial = x - s * axis;
  const double rho = radial.norm();
  const Meridian m = half_plane(rho, s);
  if (!(rho > 1e-12)) {
    if (m.n_s == 0) return {m.g, axis.unitOrthogonal(), Eigen::Matrix3d::Zero()};  // no side is nearer than another
    return {m.g, std::copysign(1.0, m.n_s) * axis, m.curvature * (Eigen::Matrix3d::Identity() - axis * axis.transpose())};
  }
  const Eigen::Vector3d out = radial / rho, around = axis.cross(out);
  const Eigen::Vector3d along = m.n_s * out - m.n_rho * axis;
  return {m.g, m.n_rho * out + m.n_s * axis, m.curvature * along * along.transpose() + m.n_rho / rho * around * around.transpose()};
}

}  // namespace palpate::tools
