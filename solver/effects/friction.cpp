// Coulomb's friction by a return to the cone, with a little elastic slip: the trial shear v − n (n·v), v = shear − ε Δplace, is scaled back to
// μ t where it is larger. (Simo and Laursen 1992, Computers & Structures 42:97, eq. 2.23–2.26; tangent with all of its terms.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/effect.hpp>

namespace palpate::effects {
namespace {

// Parameter: μ; infinite: what touches sticks.
Traction respond(const contact::Touch& touch, std::span<const double> p) {
  const auto& d = touch.distance;
  const Eigen::Vector3d v = touch.before.shear - touch.stiffness * (touch.place - touch.before.place);
  Traction trial;
  trial.value = v - d.n * d.n.dot(v);
  trial.by_place = -touch.stiffness * (Eigen::Matrix3d::Identity() - d.n * d.n.transpose()) - d.n.dot(v) * d.hessian - d.n * (d.hessian * v).transpose();
  const double size = trial.value.norm(), bound = p[0] * touch.pressure;
  if (size <= bound) return trial;
  const Eigen::Vector3d m = trial.value / size;
  return {bound * m, bound / size * (trial.by_place - m * (m.transpose() * trial.by_place)) - p[0] * touch.pressure_slope * m * d.n.transpose(), true};
}

}  // namespace

Effect friction() {
  return {.entry = {"effect", "friction", "shear between tool and organ up to mu times the pressure, after a little elastic slip",
                    "Simo and Laursen 1992, Computers & Structures 42:97, eq. 2.23-2.26",
                    {{"mu", "1", {0, 10}, 0.3, "Coulomb's coefficient"}}},
          .traction = {.respond = respond, .holds_on = true}};
}

}  // namespace palpate::effects
