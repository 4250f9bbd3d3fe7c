// Coulomb friction under a ball, in force space: F (1 + 3π/16 μ a/R s), s = ±1 while sliding, its share of slip elastic after a reversal.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect friction() {
  Effect effect;
  effect.entry = {"traction", "friction", "the surface holds on to the tool: stiffer going in, softer coming out, at any rate", "Johnson 1985, Contact Mechanics, §5.4; the factor is the mean slope r/R under Hertz' pressure",
                  {{"mu", "1", {0, 1}, 0.1, "coefficient of friction"}}};
  effect.needs_unload = true;
  effect.accuracy = 0.1;
  effect.separates = "lubricate, and repeat";
  effect.cost = 2;
  effect.needs_contact = true;
  effect.on_clamp = true;
  effect.tissue = [](double e, std::span<const double>, Tissue& tissue) { tissue.friction += e; };
  return effect;
}

}  // namespace palpate::shortcuts
