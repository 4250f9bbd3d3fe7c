// Gain of the force cell: F read is (1 + g) F.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::instruments {

Effect gain() {
  Effect effect;
  effect.entry = {"instrument", "gain", "the force cell reads too much or too little by a factor", "ISO 376:2011 (calibration of force cells)",
                  {{"g", "1", {-0.1, 0.1}, 0.01, "force read over force, minus one"}}};
  effect.known = [](const Set& set) -> std::string { return set.gain.is_candidate() ? "" : "the rig's gain is given"; };
  effect.accuracy = 0.005;
  effect.separates = "hang a known weight on the cell";
  effect.cost = 0;
  effect.force = [](const Run&, double e, std::span<const double>, Path& force) {
    for (double& F : force) F *= 1 + e;
  };
  return effect;
}

}  // namespace palpate::instruments
