// A cylinder of radius a with a flat end and an edge rounded by r: the cylinder of radius a − r above z = r, offset by r.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/offset_shapes.hpp>

#include <cmath>

namespace palpate::tools {
namespace {

/// Beyond the core's rim: the nearest core point lies on the circle of radius c at height r.
Distance from_rim(const Eigen::Vector3d& x, double rho, double c, double r) {
  const Eigen::Vector3d e(x.x() / rho, x.y() / rho, 0);
  const Eigen::Vector3d v = x - (c * e + r * Eigen::Vector3d::UnitZ());
  Distance d = from_core_point(v, r);
  const double length = v.norm();
  if (length > 1e-12) {  // the rim's own curvature around the axis replaces that of a single point
    const Eigen::Vector3d around(-e.y(), e.x(), 0);
    d.hessian += around * around.transpose() * (d.n.dot(e) / rho - 1 / length);
  }
  return d;
}

Distance distance(const Eigen::Vector3d& x, std::span<const double> p) {
  const double a = p[0], r = std::min(p[1], a), c = a - r;
  const double rho = std::hypot(x.x(), x.y());
  if (x.z() <= r && rho <= c) return {-x.z(), -Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero()};
  if (x.z() < r) return from_rim(x, rho, c, r);
  if (rho < c && x.z() < c - rho + r) return {-x.z(), -Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero()};  // inside: the end is nearest
  return from_core_line(x, a);
}

}  // namespace

Shape flat_punch() {
  return {{"tool", "flat_punch", "a rigid cylinder with a flat end and a rounded edge",
           "Sneddon 1965, Int. J. Eng. Sci. 3:47 (force); edge radius so that the normal is defined everywhere",
           {{"radius_mm", "mm", {1e-3, 1e3}, 2.5, "radius of the cylinder"},
            {"edge_radius_mm", "mm", {1e-4, 1e3}, 0.25, "radius of the rounded edge, at most the cylinder's"}}},
          distance};
}

}  // namespace palpate::tools
