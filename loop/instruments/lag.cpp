// Lag: the force read follows the force with a delay, τ Ḟr + Fr = F.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>
#include <cmath>

namespace palpate::instruments {

Effect lag() {
  Effect effect;
  effect.entry = {"instrument", "lag", "the force channel is late: filtered, or read after the displacement", "Oppenheim and Willsky 1997, Signals and Systems, §6.5 (first-order lag)",
                  {{"tau", "s", {0, 0.5}, 0.02, "time constant of the force channel"}}};
  effect.needs_hold = true;
  effect.accuracy = 0.005;
  effect.separates = "press on a rigid block at two speeds (phase = block)";
  effect.needs_time = true;
  effect.force = [](const Run& run, double e, std::span<const double>, Path& force) {
    if (!(e > 0)) return;
    double read = force.front(), before = force.front();
    for (std::size_t i = 1; i < force.size(); ++i) {  // exact for a force that is straight between samples
      const double dt = run.t[i] - run.t[i - 1], kept = std::exp(-dt / e), slope = (force[i] - before) / dt;
      read = force[i] - slope * e + (read - before + slope * e) * kept;
      before = force[i];
      force[i] = read;
    }
  };
  return effect;
}

}  // namespace palpate::instruments
