// P = η P_e, η = 1 − 1/r erf((W_m − W)/m), W_m the largest energy the point has known: on the way back, and again up to the old
// maximum, the tissue is softer. (Ogden and Roxburgh 1999, Proc. R. Soc. A 455:2861, eq. 5.1.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/effects/second_stress.hpp>

#include <numbers>

namespace palpate::effects {
namespace {

// Memory: W_m. Parameters: 1/r, m.
Response respond(const Inner& inner, const Point& point, std::span<const double> memory, std::span<const double> p) {
  Response r = inner(point.F);
  const double below = (memory[0] - r.W) / p[1];
  if (!(below > 0)) return r;
  const double eta = 1 - p[0] * std::erf(below);
  if (point.wants_tangent()) {
    const double slope = p[0] * 2 * std::numbers::inv_sqrtpi * std::exp(-below * below) / p[1];  // ∂η/∂W
    const Vec9 P = Eigen::Map<const Vec9>(r.P.data());
    r.A = eta * r.A + slope * P * P.transpose();
  }
  r.P *= eta;
  return r;
}

void remember(const Inner& inner, const Point& point, std::span<double> memory, std::span<const double>) {
  memory[0] = std::max(memory[0], inner(point.F).W);
}

}  // namespace

Effect mullins() {
  return {{"effect", "mullins", "softening by what the tissue has borne: softer below the largest energy it has known",
           "Ogden and Roxburgh 1999, Proc. R. Soc. A 455:2861, eq. 5.1",
           {{"inverse_r", "1", {0, 0.999}, 0.3, "1/r: the largest part of the stress that is lost"},
            {"m", "MPa", {1e-12, 1e6}, 0.001, "energy below the maximum over which it is lost"}}},
          false,
          {[](std::span<const double>) { return 1; }, respond, remember}};
}

}  // namespace palpate::effects
