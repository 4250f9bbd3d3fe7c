// Jaw angle: the jaws' faces are not parallel, but turned against each other about the tube's direction, as scissors' are.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect jaw_angle() {
  Effect effect;
  effect.entry = {"clamp", "jaw_angle", "the clamp's jaws are not parallel", "solved: palpate-solve, scheme explicit, [clamp] angle_deg",
                  {{"angle", "deg", {0, 8}, 2, "between the faces, the gap being that of their middles"}}};
  effect.accuracy = 0.1;
  effect.on_clamp = effect.clamp_only = true;
  effect.separates = "press the jaws on a soft sheet and measure the dent on both sides; turn the clamp by 180 degrees";
  effect.cost = 0;
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double>, Tissue& tissue) { tissue.jaw_angle_deg += e; };
  return effect;
}

}  // namespace palpate::shortcuts
