// Drift: F read is F + d t, t since the run began, or since the session began.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::instruments {

Effect drift() {
  Effect effect;
  effect.entry = {"instrument", "drift", "the zero of the force cell wanders steadily", "ISO 376:2011 (creep and drift of force cells)",
                  {{"d", "N/s", {-0.1, 0.1}, 0.0001, "force read without load, per second"},
                     {"clock", "1", {0, 1}, 0, "0: zeroed before each run, 1: once for the session"}}};
  effect.accuracy = 0.005;
  effect.separates = "an air run as long as the others; repeat the first run last";
  effect.grid = {{0}, {1}};
  effect.refines = false;
  effect.needs_time = true;
  effect.force = [](const Run& run, double e, std::span<const double> shape, Path& force) {
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += e * (run.t[i] - run.t.front() + shape[0] * run.session_s);
  };
  return effect;
}

}  // namespace palpate::instruments
