// A block, its lower face on z = 0, all edges rounded by r: the block smaller by r on every side, offset by r.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/tool.hpp>

#include <algorithm>

namespace palpate::tools {
namespace {

using Eigen::Vector3d;

Distance distance(const Vector3d& x, std::span<const double> p) {
  const Vector3d half = Vector3d(p[0], p[1], p[2]) / 2;
  const double r = std::min(p[3], half.minCoeff());
  const Vector3d from_centre = x - half.z() * Vector3d::UnitZ();
  const Vector3d side = from_centre.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; });
  const Vector3d excess = from_centre.cwiseAbs() - (half - Vector3d::Constant(r));  // beyond the core
  const Vector3d outside = excess.cwiseMax(0);
  const double length = outside.norm();
  if (!(length > 0)) {  // within the core: the nearest face counts
    int k = 0;
    const double g = excess.maxCoeff(&k) - r;
    return {g, side(k) * Vector3d::Unit(k), Eigen::Matrix3d::Zero()};
  }
  const Vector3d n = side.cwiseProduct(outside) / length;
  const Vector3d free = (outside.array() > 0).cast<double>();
  return {length - r, n, (Eigen::Matrix3d(free.asDiagonal()) - n * n.transpose()) / length};
}

}  // namespace

Shape box() {
  return {{"tool", "box", "a rigid block with a flat face ahead and rounded edges; two of them with opposite axes are a pair of jaws",
           "Johnson 1985, Contact Mechanics, section 2.8 (Cambridge University Press)",
           {{"width_mm", "mm", {1e-3, 1e4}, 10, "along `across`"},
            {"length_mm", "mm", {1e-3, 1e4}, 40, "at right angles to `across` and to the axis"},
            {"height_mm", "mm", {1e-3, 1e4}, 10, "along the axis"},
            {"edge_radius_mm", "mm", {1e-4, 1e3}, 0.5, "radius of the rounded edges, at most half the smallest side"}}},
          distance};
}

}  // namespace palpate::tools
