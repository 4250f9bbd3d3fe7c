// Tare: F read is F + F0.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::instruments {

Effect tare() {
  Effect effect;
  effect.entry = {"instrument", "tare", "the force cell does not read zero without load", "ISO 376:2011 (zero of force cells)",
                  {{"F0", "N", {-5, 5}, 0.01, "force read without load"}}};
  effect.accuracy = 0.005;
  effect.separates = "an air run";
  effect.cost = 0;
  effect.force = [](const Run&, double e, std::span<const double>, Path& force) {
    for (double& F : force) F += e;
  };
  return effect;
}

}  // namespace palpate::instruments
