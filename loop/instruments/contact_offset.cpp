// Contact offset: the true depth is u + δ0.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::instruments {

Effect contact_offset() {
  Effect effect;
  effect.entry = {"instrument", "contact_offset", "the surface was touched earlier or later than the zero of displacement says", "Dimitriadis et al. 2002, Biophys. J. 82:2798 (contact point)",
                  {{"delta0", "mm", {-2, 2}, 0.05, "true depth minus depth read"}}};
  effect.known = [](const Set& set) -> std::string {
    for (const Run& run : set.runs)
      if (run.test == Test::indentation && run.role == Role::fit && run.zero != "tool_start") return "";
    return "the tool's zero is unknown and fitted already";
  };
  effect.accuracy = 0.005;
  effect.separates = "record the approach from well above the surface; press with a second radius";
  effect.needs_contact = true;
  effect.depth = [](const Run&, double e, std::span<const double>, Path& depth) {
    for (double& d : depth) d += e;
  };
  return effect;
}

}  // namespace palpate::instruments
