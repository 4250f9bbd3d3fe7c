// Coulomb friction under a ball, in force space: where all of the contact slips, and as solved for an incompressible tissue (model.cpp, decision 043).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect friction() {
  Effect effect;
  effect.entry = {"traction", "friction", "the surface holds on to the tool: stiffer going in, softer coming out, at any rate", "Johnson 1985, Contact Mechanics, §5.4; the factor is the mean slope r/R under Hertz' pressure",
                  {{"mu", "1", {0, 1}, 0.1, "coefficient of friction"}, {"as_solved", "1", {0, 1}, 0, "0: all of the contact slips; 1: as solved for an incompressible tissue, which slips little"}}};
  effect.needs_unload = true;
  effect.accuracy = 0.1;
  effect.refines = false;
  effect.grid_of = [](const Set& set) { return set.specimen.shape == "tube" ? std::vector<std::vector<double>>{{0}} : std::vector<std::vector<double>>{{0}, {1}}; };
  effect.separates = "lubricate, and repeat";
  effect.cost = 2;
  effect.needs_contact = true;
  effect.on_clamp = true;
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) { tissue.friction += e; tissue.friction_slips = shape[0] == 0; };
  return effect;
}

}  // namespace palpate::shortcuts
