// Thickness: the layer is (1 + e) times as thick as stated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect thickness() {
  Effect effect;
  effect.entry = {"start", "thickness", "the specimen is thicker or thinner under the tool than stated", "Dhaliwal and Rau 1970, Int. J. Eng. Sci. 8:843",
                  {{"excess", "1", {-0.6, 1.5}, 0.05, "true over stated thickness, minus one"}}};
  effect.accuracy = 0.05;
  effect.separates = "measure the thickness there; two radii";
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double>, Tissue& tissue) { tissue.thickness_factor *= 1 + e; };
  return effect;
}

}  // namespace palpate::shortcuts
