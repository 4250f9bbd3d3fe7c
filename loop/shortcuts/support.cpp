// Support: what carries the specimen gives way, u − F/k.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect support() {
  Effect effect;
  effect.entry = {"force", "support", "what carries the specimen gives way", "Johnson 1985, Contact Mechanics, §1 (stiffnesses in series)",
                  {{"compliance", "mm/N", {0, 0.5}, 0.02, "compliance of the support"}}};
  effect.accuracy = 0.02;
  effect.separates = "glue the specimen down; press on a rigid block (phase = block)";
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double>, Tissue& tissue) { tissue.support_mm_per_N += e; };
  return effect;
}

}  // namespace palpate::shortcuts
