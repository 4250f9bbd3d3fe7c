// Compliance of the rig: the true depth is u − c F.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::instruments {

Effect rig_compliance() {
  Effect effect;
  effect.entry = {"instrument", "rig_compliance", "the rig gives way: the tool goes less deep than is read", "Oliver and Pharr 1992, J. Mater. Res. 7:1564 (frame compliance)",
                  {{"c", "mm/N", {0, 0.5}, 0.02, "compliance of frame, cell and shaft"}}};
  effect.known = [](const Set& set) -> std::string { return set.compliance_mm_per_N.is_candidate() ? "" : "the rig's compliance is given"; };
  effect.separates = "press on a rigid block (phase = block)";
  effect.needs_contact = true;
  effect.compliance = [](double e) { return e; };
  return effect;
}

}  // namespace palpate::instruments
