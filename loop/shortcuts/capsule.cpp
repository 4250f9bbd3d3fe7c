// Capsule: a thin elastic skin stretched by the dimple, 3 c2 E h δ²/R.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect capsule() {
  Effect effect;
  effect.entry = {"layer", "capsule", "a thin stiff skin lies on the tissue: wide dimples, more for small tools", "Johnson 1985, Contact Mechanics, eq. 3.42 (deflection); energy of stretch over it",
                  {{"Eh", "N/mm", {0, 100}, 0.02, "Young's modulus times thickness of the skin"}}};
  effect.separates = "two radii";
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double>, Tissue& tissue) { tissue.capsule_N_per_mm += e; };
  return effect;
}

}  // namespace palpate::shortcuts
