// A cylinder of radius a with a flat end and an edge rounded by r: the cylinder of radius a − r above z = r, offset by r.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/offset_shapes.hpp>

#include <algorithm>

namespace palpate::tools {
namespace {

Distance distance(const Eigen::Vector3d& x, std::span<const double> p) {
  const double a = p[0], r = std::min(p[1], a);
  return revolved(x, -Eigen::Vector3d::UnitZ(), [&](double rho, double s) { return rounded_corner(s + r, rho - (a - r), r); });
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
