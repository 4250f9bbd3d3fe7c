// Compressibility: ν below ½.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect compressibility() {
  Effect effect;
  effect.entry = {"material", "compressibility", "the tissue loses volume under pressure: softer where it is confined", "Johnson 1985, Contact Mechanics, §5.8",
                  {{"half_minus_nu", "1", {0, 0.2}, 0.02, "½ − ν"}}};
  effect.accuracy = 0.05;
  effect.separates = "a second thickness";
  effect.cost = 2;
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double>, Tissue& tissue) { tissue.nu -= e; };
  return effect;
}

}  // namespace palpate::shortcuts
