// A cylinder of radius a whose end is a dome of radius R ≥ a, its edge rounded by e: dome of radius R − e and cylinder of radius a − e,
// which meet at z_rim = R − √((R − e)² − (a − e)²), offset by e.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/offset_shapes.hpp>

#include <algorithm>

namespace palpate::tools {
namespace {

Distance distance(const Eigen::Vector3d& x, std::span<const double> p) {
  const double a = p[0], R = std::max(p[1], a), e = std::min(p[2], a);
  const double core = a - e, core_dome = R - e, above_rim = std::sqrt(core_dome * core_dome - core * core), rim = R - above_rim;
  return revolved(x, -Eigen::Vector3d::UnitZ(), [&](double rho, double s) {
    const double z = -s, from_centre = std::hypot(rho, R - z);
    const Meridian side{rho - a, 1, 0, 0};
    const Meridian dome{from_centre - R, rho / from_centre, (R - z) / from_centre, 1 / from_centre};
    const bool within_core = rho <= core && (z >= R || from_centre <= core_dome);
    if (within_core) return z < R && dome.g > side.g ? dome : side;
    if (z >= rim && rho > core) return side;
    return rho * above_rim <= (R - z) * core ? dome : rounded_corner(rim - z, rho - core, e);
  });
}

}  // namespace

Shape rounded_punch() {
  return {{"tool", "rounded_punch", "a rigid cylinder with a domed end, flatter than a hemisphere, and a rounded edge",
           "Maugis, Barquins 1983, J. Phys. D 16:1843",
           {{"radius_mm", "mm", {1e-3, 1e3}, 2.5, "radius of the cylinder"},
            {"dome_radius_mm", "mm", {1e-3, 1e5}, 5, "radius of curvature of its end, at least the cylinder's"},
            {"edge_radius_mm", "mm", {1e-4, 1e3}, 0.25, "radius of the rounded edge, at most the cylinder's"}}},
          distance};
}

}  // namespace palpate::tools
