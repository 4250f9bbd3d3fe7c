// g = |x − R e_z| − R.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/offset_shapes.hpp>

namespace palpate::tools {
namespace {

Distance distance(const Eigen::Vector3d& x, std::span<const double> p) {
  return from_core_point(x - p[0] * Eigen::Vector3d::UnitZ(), p[0]);
}

}  // namespace

Shape ball() {
  return {{"tool", "ball", "a rigid ball", "Hertz 1882, J. reine angew. Math. 92:156",
           {{"radius_mm", "mm", {1e-3, 1e3}, 2.5, "radius of the ball"}}},
          distance};
}

}  // namespace palpate::tools
