// The tool holds the surface by −σ(g) n, σ = w/r (1 + cos(π g/r)) up to the range r and 2 w/r where it touches: the work to part them is w per area.
// (Cohesive forces of a range: Barenblatt 1962, Adv. Appl. Mech. 7:55; work of adhesion: Johnson, Kendall and Roberts 1971, Proc. R. Soc. A 324:301.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/effect.hpp>

#include <numbers>

namespace palpate::effects {
namespace {

// Parameters: w in J/m², r.
Traction respond(const contact::Touch& touch, std::span<const double> p) {
  const double strength = 1e-3 * p[0] / p[1], angle = std::numbers::pi * std::max(0.0, touch.distance.g) / p[1];
  if (angle >= std::numbers::pi) return {};
  const double stress = strength * (1 + std::cos(angle)), slope = -strength * std::sin(angle) * std::numbers::pi / p[1];
  const auto& n = touch.distance.n;
  return {-stress * n, -slope * n * n.transpose() - stress * touch.distance.hessian};
}

}  // namespace

Effect adhesion() {
  return {.entry = {"effect", "adhesion", "the surface clings to the tool: it is pulled towards it, also when it is drawn back",
                    "Barenblatt 1962, Adv. Appl. Mech. 7:55; Johnson, Kendall and Roberts 1971, Proc. R. Soc. A 324:301",
                    {{"work", "J/m^2", {0, 100}, 0.1, "work of adhesion"},
                     {"range_mm", "mm", {1e-4, 10}, 0.5, "gap at which it ends: not much below the faces' size, or parts jump on and off"}}},
          .traction = {.respond = respond, .reach = [](std::span<const double> p) { return p[1]; }}};
}

}  // namespace palpate::effects
