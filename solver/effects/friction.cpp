// Coulomb's friction with a little elastic slip: shear = v − n (n·v), v = shear before − ε Δplace, up to μ t. (contact/coulomb.hpp)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/coulomb.hpp>
#include <solver/effects/effect.hpp>

namespace palpate::effects {
namespace {

// Parameter: μ; infinite: what touches sticks.
Traction respond(const contact::Touch& touch, std::span<const double> p) {
  const auto& d = touch.distance;
  const auto c = contact::coulomb(touch.before.shear - touch.stiffness * (touch.place - touch.before.place), d.n, p[0], touch.pressure, touch.branch);
  return {c.shear, -touch.stiffness * c.by_trial + c.by_normal * d.hessian - touch.pressure_slope * c.by_pressure * d.n.transpose(), c.slides, c.beyond};
}

}  // namespace

Effect friction() {
  return {.entry = {"effect", "friction", "shear between tool and organ up to mu times the pressure, after a little elastic slip",
                    "Simo and Laursen 1992, Computers & Structures 42:97, eq. 2.23-2.26",
                    {{"mu", "1", {0, 10}, 0.3, "Coulomb's coefficient"}}},
          .traction = {.respond = respond, .holds_on = true}};
}

}  // namespace palpate::effects
