// How far to go along Newton's step: the slope s(a) = Δ·r(u + a Δ) is about to vanish.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/equilibrium.hpp>

#include <cmath>

namespace palpate::implicit {

/// Work of the unbalanced forces along a step: the slope of the potential energy on the way, as far as the step keeps the volume.
double Equilibrium::slope(const Trial& trial, const Increment& step) const {
  double sum = 0;
  for (int i = 0; i < step.nodal.size(); ++i)
    if (i % 4 != 3 && !fixed_[i]) sum += step.nodal(i) * trial.equations.residual(i);
  for (std::size_t i = 0; i < step.travels.size(); ++i) sum += step.travels[i] * trial.excess[i];
  return sum;
}

/// Full steps where they neither invert an element, nor let the residual jump, nor climb the potential; else the length at which the
/// slope is about to vanish, by false position (Matthies and Strang 1979, Int. J. Numer. Meth. Eng. 14:1613), or half of it.
bool Equilibrium::line_search(Trial& trial, const Increment& step) {
  trouble_ = {};
  const Trial start = trial;
  const double slope_before = slope(start, step);
  const bool downhill = slope_before < 0 && start.prescribed.isZero(0);
  double low = 0, low_slope = slope_before, high = 1, length = 1;
  bool sound = false;
  for (int evaluation = 0; evaluation < 12 && length > 1e-3; ++evaluation) {
    sound = evaluate(trial, start, step, length);
    const double now = sound && downhill ? slope(trial, step) : 0;
    const bool jumped = !sound || !(trial.residual <= 10 * start.residual || (!downhill && length < 0.2));
    if (sound && trial.residual <= 0.1 * start.residual) return true;
    if (jumped || now > 0.5 * std::abs(slope_before)) {
      high = length;
      length = now > 0 ? low + (high - low) * low_slope / (low_slope - now) : (low + high) / 2;
    } else if (now >= 0.5 * slope_before || length == 1) {
      return true;
    } else {
      low = length;
      low_slope = now;
      length = (low + high) / 2;
    }
  }
  return sound && std::isfinite(trial.residual);
}

}  // namespace palpate::implicit
