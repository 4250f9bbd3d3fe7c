// Saturation: F read is min(F, Fs).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>
#include <algorithm>

namespace palpate::instruments {

Effect saturation() {
  Effect effect;
  effect.entry = {"instrument", "saturation", "the force cell cannot read more than a limit", "ISO 376:2011 (range of force cells)",
                  {{"limit", "N^-1", {0, 1e4}, 0.01, "one over the largest force that is read: 1/Fs"}}};
  effect.told_inverse = true;
  effect.accuracy = 0.005;
  effect.separates = "a softer site, or a smaller tool";
  effect.probe_of = [](const Set& set) {  // well below the largest force read, where the null model, fitted to what was cut, still goes beyond it
    double largest = 1e-12;
    for (const Run& run : set.runs)
      if (run.role == Role::fit) largest = std::max(largest, *std::max_element(run.F.begin(), run.F.end()));
    return 1 / (0.85 * largest);
  };
  effect.force = [](const Run&, double e, std::span<const double>, Path& force) {
    if (!(e > 0)) return;
    for (double& F : force) F = std::min(F, 1 / e);
  };
  return effect;
}

}  // namespace palpate::instruments
