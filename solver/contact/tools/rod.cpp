// A half-line from (0, 0, R) upwards, offset by R: a rod with a hemispherical tip.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/offset_shapes.hpp>

namespace palpate::tools {
namespace {

Distance distance(const Eigen::Vector3d& x, std::span<const double> p) {
  const double R = p[0];
  return x.z() < R ? from_core_point(x - R * Eigen::Vector3d::UnitZ(), R) : from_core_line(x, R);
}

}  // namespace

Shape rod() {
  return {{"tool", "rod", "a rigid rod with a hemispherical tip, longer than the organ is deep", "the kidney paper's indenter (2005)",
           {{"radius_mm", "mm", {1e-3, 1e3}, 2.5, "radius of rod and tip"}}},
          distance};
}

}  // namespace palpate::tools
