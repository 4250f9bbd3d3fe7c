// Pre-stress: a tension under the surface carries 2 c1 T δ.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect prestress() {
  Effect effect;
  effect.entry = {"start", "prestress", "the tissue is under tension before it is touched: a force in proportion to depth", "Johnson 1985, Contact Mechanics, eq. 3.42 (deflection); energy of tension over it",
                  {{"tension", "N/mm", {0, 10}, 0.001, "tension per length under the surface"}}};
  effect.accuracy = 0.05;
  effect.separates = "change the perfusion pressure";
  effect.cost = 2;
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double>, Tissue& tissue) { tissue.tension_N_per_mm += e; };
  return effect;
}

}  // namespace palpate::shortcuts
