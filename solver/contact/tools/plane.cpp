// The half-space z > 0: g = −z.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/tool.hpp>

namespace palpate::tools {
namespace {

Distance distance(const Eigen::Vector3d& x, std::span<const double>) {
  return {-x.z(), -Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero()};
}

}  // namespace

Shape plane() {
  return {{"tool", "plane", "a rigid plane at right angles to its axis, wider than the organ: a plate, a table",
           "Kikuchi, Oden 1988, Contact Problems in Elasticity (SIAM)", {}},
          distance};
}

}  // namespace palpate::tools
