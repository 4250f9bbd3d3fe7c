// Rate: F (1 + m sign(v) ln(1 + |v|/v0)), v the speed of loading over the largest depth.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect rate() {
  Effect effect;
  effect.entry = {"stress", "rate", "the tissue is stiffer when loaded faster; the surplus drops at once when the tool stops", "Fung 1993, Biomechanics, §7.5 (strain rate); logarithmic law",
                  {{"m", "1", {0, 0.3}, 0.01, "growth of the force per e-fold of rate"},
                     {"v0", "1/s", {1e-4, 10}, 0.01, "rate at which it begins"}}};
  effect.needs_hold = true;
  effect.separates = "the same run at three rates";
  effect.grid = {{0.001}, {0.01}, {0.1}};
  effect.refines = false;
  effect.needs_time = true;
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) { tissue.rate += e; tissue.rate_reference_per_s = shape[0]; };
  return effect;
}

}  // namespace palpate::shortcuts
