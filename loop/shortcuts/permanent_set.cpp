// Permanent set: the rest length follows the largest strain, p = f (e_max − yield).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect permanent_set() {
  Effect effect;
  effect.entry = {"stress", "permanent_set", "the tissue keeps part of its deformation: on reloading contact is found later", "Dorfmann and Ogden 2004, Int. J. Solids Struct. 41:1855 (residual strain)",
                  {{"fraction", "1", {0, 0.9}, 0.03, "part of the strain beyond the yield that stays"},
                     {"yield", "1", {0, 0.9}, 0, "where it begins, relative to the deepest point"}}};
  effect.needs_unload = true;
  effect.accuracy = 0.15;
  effect.separates = "rest long, then find contact again";
  effect.grid = {{0}, {0.4}};
  effect.refines = false;
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) { tissue.set_fraction = e; tissue.set_yield = shape[0]; };
  return effect;
}

}  // namespace palpate::shortcuts
