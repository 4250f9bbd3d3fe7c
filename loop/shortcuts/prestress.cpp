// Pre-stress: a tension under the surface carries 2 c1 T δ; all through an organ of its own mesh it is solved.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect prestress() {
  Effect effect;
  effect.entry = {"start", "prestress", "the tissue is under tension before it is touched: a force in proportion to depth", "Johnson 1985, Contact Mechanics, eq. 3.42 (deflection); energy of tension over it",
                  {{"tension", "N/mm", {0, 10}, 0.001, "tension per length under the surface; with `through` per area, N/mm^2"},
                     {"through", "1", {0, 1}, 0, "0: a tension under the surface; 1: all through an organ, in balance with a pressure in it, as palpate-solve has it"}}};
  effect.accuracy = 0.05;
  effect.separates = "change the perfusion pressure";
  effect.cost = 2;
  effect.needs_contact = true;
  effect.refines = false;
  effect.grid_of = [](const Set& set) { return std::vector<std::vector<double>>{{set.specimen.case_file.empty() ? 0.0 : 1.0}}; };
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) { (shape[0] > 0 ? tissue.turgor_MPa : tissue.tension_N_per_mm) += e; };
  return effect;
}

}  // namespace palpate::shortcuts
