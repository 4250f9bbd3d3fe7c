// Modulus · (1 + excess) in a ball around a place, with a soft edge: a lump that is stiffer or softer than the tissue around it.
// (The field around such a ball: Eshelby 1957, Proc. R. Soc. A 241:376.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/effect.hpp>
#include <solver/effects/zone.hpp>

namespace palpate::effects {
namespace {

// Parameters: excess, place, radius, edge.
void begin(const Eigen::Vector3d& place, std::span<const double> p, Start& start) {
  start.modulus *= 1 + p[0] * inside((place - Eigen::Vector3d(p[1], p[2], p[3])).norm(), p[4], p[5]);
}

}  // namespace

Effect inclusion() {
  return {.entry = {"effect", "inclusion", "a ball of tissue that is stiffer or softer than what lies around it", "Eshelby 1957, Proc. R. Soc. A 241:376",
                    {{"excess", "1", {-0.95, 1000}, 1, "its stiffness over that of the tissue around it, minus one"},
                     {"x_mm", "mm", {-1e4, 1e4}, 0, "its middle, in the patient's frame, at rest"},
                     {"y_mm", "mm", {-1e4, 1e4}, 0, "its middle"},
                     {"z_mm", "mm", {-1e4, 1e4}, 0, "its middle"},
                     {"radius_mm", "mm", {1e-3, 1e3}, 5, "its radius, to the middle of its edge"},
                     {"edge_mm", "mm", {1e-3, 1e3}, 1, "width over which the stiffness changes: about a tetrahedron's"}}},
          .fallbacks = {1},
          .start = {.begin = begin}};
}

}  // namespace palpate::effects
