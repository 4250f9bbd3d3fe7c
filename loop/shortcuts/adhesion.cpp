// Adhesion: a spring holds on until its energy is the work of adhesion of the ring it stands for (loop/forward/adhesion.hpp).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect adhesion() {
  Effect effect;
  effect.entry = {"traction", "adhesion", "the surface sticks: the tool is pulled back on retraction", "Johnson, Kendall and Roberts 1971; Shull 2002",
                  {{"work", "J/m^2", {0, 10}, 0.1, "work of adhesion"},
                     {"always", "1", {0, 1}, 0, "0: on retraction only, 1: on approach too"}}};
  effect.needs_unload = true;
  effect.accuracy = 0.2;
  effect.difference = 0.03;
  effect.separates = "retract past contact";
  effect.grid = {{0}, {1}};
  effect.refines = false;
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) { tissue.adhesion_J_per_m2 += e; tissue.adhesion_on_retract_only = shape[0] < 0.5; };
  return effect;
}

}  // namespace palpate::shortcuts
