// Capsule: a thin elastic skin stretched by the dimple: E h δ²/R (0.2 + 3.6 √x χ), as backbone.hpp says.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect capsule() {
  Effect effect;
  effect.entry = {"layer", "capsule", "a thin stiff skin lies on the tissue: wide dimples, more for small tools", "fitted to a membrane on a layer by GetFEM (decision 042)",
                  {{"Eh", "N/mm", {0, 100}, 0.02, "Young's modulus times thickness of the skin"}}};
  effect.accuracy = 0.1;
  effect.separates = "two radii";
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double>, Tissue& tissue) { tissue.capsule_N_per_mm += e; };
  return effect;
}

}  // namespace palpate::shortcuts
