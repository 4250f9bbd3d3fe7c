// A cylinder along x, centred at (0, 0, R), its end edges rounded by r: the cylinder of radius R − r and length L − 2 r, offset by r.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/offset_shapes.hpp>

#include <algorithm>

namespace palpate::tools {
namespace {

Distance distance(const Eigen::Vector3d& x, std::span<const double> p) {
  const double R = p[0], half = p[1] / 2, r = std::min({p[2], R, half});
  return revolved(x - R * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), [&](double rho, double s) {
    Meridian m = rounded_corner(std::abs(s) - (half - r), rho - (R - r), r);
    m.n_s = s < 0 ? -m.n_s : m.n_s;
    return m;
  });
}

}  // namespace

Shape cylinder() {
  return {{"tool", "cylinder", "a rigid cylinder that lies along `across` and is pressed sideways, its ends with rounded edges",
           "Johnson 1985, Contact Mechanics, section 4.2 (Cambridge University Press)",
           {{"radius_mm", "mm", {1e-3, 1e3}, 2.5, "radius of the cylinder"},
            {"length_mm", "mm", {1e-3, 1e4}, 20, "from end to end"},
            {"edge_radius_mm", "mm", {1e-4, 1e3}, 0.25, "radius of the rounded edges; the cylinder's own makes the ends hemispheres"}}},
          distance};
}

}  // namespace palpate::tools
