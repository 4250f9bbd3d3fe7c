// Mullins: below the largest strain so far the stress is η of its first value, η = 1 − (1/r) erf((W_max − W)/m²).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect mullins() {
  Effect effect;
  effect.entry = {"stress", "mullins", "the tissue softens on first loading and reloads along its last unloading", "Ogden and Roxburgh 1999, Proc. R. Soc. A 455:2861, eq. 3.10",
                  {{"inverse_r", "1", {0, 0.9}, 0.05, "1/r, the share of stress that can be lost"},
                     {"m", "1", {0.02, 3}, 0.3, "strain energy scale, relative to the deepest point"}}};
  effect.needs_unload = true;
  effect.accuracy = 0.03;
  effect.separates = "cycles of growing depth, then rest and repeat";
  effect.grid = {{0.1}, {0.3}, {1}};
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) { tissue.mullins = e; tissue.mullins_scale = shape[0]; };
  return effect;
}

}  // namespace palpate::shortcuts
