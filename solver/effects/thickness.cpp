// X → X + excess w(d) n (n·(X − X0)): the organ is (1 + excess) times as thick along n, measured from the plane through X0; everywhere, or in a
// zone of a radius around the line through X0 along n, d away from it. (A map of the rest shape: Gurtin 1981, Introduction to Continuum Mechanics, §5.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/effect.hpp>
#include <solver/effects/zone.hpp>

namespace palpate::effects {
namespace {

// Parameters: excess, n, X0, radius, edge.
struct Place {
  double along, from_line;
  Eigen::Vector3d n;
};

Place seen(const Eigen::Vector3d& point, std::span<const double> p) {
  const Eigen::Vector3d n = Eigen::Vector3d(p[1], p[2], p[3]).normalized(), from = point - Eigen::Vector3d(p[4], p[5], p[6]);
  return {from.dot(n), (from - from.dot(n) * n).norm(), n};
}

double thickness(const Eigen::Vector3d& point, std::span<const double> p) { return 1 + p[0] * inside(seen(point, p).from_line, p[7], p[8]); }

Eigen::Vector3d shape(const Eigen::Vector3d& point, std::span<const double> p) {
  const Place at = seen(point, p);
  return point + (thickness(point, p) - 1) * at.along * at.n;
}

std::string objection(std::span<const double> p) {
  return Eigen::Vector3d(p[1], p[2], p[3]).norm() > 1e-9 ? "" : "axis_x, axis_y, axis_z have no direction";
}

}  // namespace

Effect thickness() {
  return {.entry = {"effect", "thickness", "the organ is thicker or thinner than its mesh says, everywhere or in a zone",
                    "Gurtin 1981, An Introduction to Continuum Mechanics, section 5 (a map of the rest shape)",
                    {{"excess", "1", {-0.9, 10}, 0.1, "true thickness over the mesh's, minus one"},
                     {"axis_x", "1", {-1e3, 1e3}, 0, "direction in which thickness is meant; need not be a unit vector"},
                     {"axis_y", "1", {-1e3, 1e3}, 0, "of that direction"},
                     {"axis_z", "1", {-1e3, 1e3}, 1, "of that direction"},
                     {"x_mm", "mm", {-1e4, 1e4}, 0, "a point that stays where it is: of the base, in the middle of the zone"},
                     {"y_mm", "mm", {-1e4, 1e4}, 0, "of that point"},
                     {"z_mm", "mm", {-1e4, 1e4}, 0, "of that point"},
                     {"radius_mm", "mm", {1e-3, 1e9}, 6, "of the zone around the line through the point along the direction"},
                     {"edge_mm", "mm", {1e-3, 1e9}, 4, "width over which the thickness changes"}}},
          .objection = objection,
          .fallbacks = {0, 0, 0, 1e9, 1},
          .start = {.shape = shape, .thickness = thickness}};
}

}  // namespace palpate::effects
