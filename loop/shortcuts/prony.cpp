// Viscoelasticity with one relaxation time: every stress decays by (1 − g (1 − exp(−t/τ))).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect prony() {
  Effect effect;
  effect.entry = {"stress", "prony", "the tissue relaxes: stress decays while the shape is held", "Simo and Hughes 1998, Computational Inelasticity, §10.3; Lee and Radok 1960",
                  {{"g", "1", {0, 0.98}, 0.05, "share of the stress that relaxes"},
                     {"tau", "s", {0.01, 1000}, 1, "relaxation time"}}};
  effect.needs_hold = true;
  effect.repeats = true;
  effect.separates = "hold longer, at two depths; rest and repeat; a second radius";
  effect.grid = {{0.1}, {0.3}, {1}, {3}, {10}, {30}, {100}};
  effect.needs_time = true;
  effect.on_clamp = true;
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) { tissue.prony.push_back({e, shape[0]}); };
  return effect;
}

}  // namespace palpate::shortcuts
