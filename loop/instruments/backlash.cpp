// Backlash: after a reversal the tool stands still until the play is used up (play operator).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>
#include <algorithm>

namespace palpate::instruments {

Effect backlash() {
  Effect effect;
  effect.entry = {"instrument", "backlash", "the drive has play: after each reversal the tool stands still for a while", "Visintin 1994, Differential Models of Hysteresis, §III.2 (play)",
                  {{"play", "mm", {0, 0.2}, 0.02, "free travel at a reversal"}}};
  effect.needs_unload = true;
  effect.separates = "press on a rigid block and reverse (phase = block)";
  effect.needs_contact = true;
  effect.depth = [](const Run&, double e, std::span<const double>, Path& depth) {
    double at = depth.empty() ? 0 : depth.front();
    for (double& d : depth) d = at = std::clamp(at, d, d + e);
  };
  return effect;
}

}  // namespace palpate::instruments
