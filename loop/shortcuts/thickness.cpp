// Thickness: the layer is (1 + e) times as thick as stated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

namespace palpate::shortcuts {

Effect thickness() {
  Effect effect;
  effect.entry = {"start", "thickness", "the specimen is thicker or thinner under the tool than stated", "Dhaliwal and Rau 1970, Int. J. Eng. Sci. 8:843",
                  {{"excess", "1", {-0.6, 1.5}, 0.05, "true over stated thickness, minus one"},
                     {"place", "mm", {-1e4, 1e4}, 0, "of a clamped tube: the middle of the zone that is so, along the tube"},
                     {"half", "mm", {2, 1e4}, 10, "half of the zone's length"}}};
  effect.on_clamp = true;
  effect.grid_of = [](const Set& set) -> std::vector<std::vector<double>> {
    if (set.specimen.shape != "tube") return {{}};
    const double length = set.specimen.size_mm[2];
    std::vector<std::vector<double>> grid;  // a whole tube that is thicker is as good as a stiffer one
    for (double place = 8; place < length - 4; place += 8)
      for (double half : {6.0, 12.0}) grid.push_back({place, half});
    return grid;
  };
  effect.accuracy = 0.05;
  effect.separates = "measure the thickness there; two radii";
  effect.needs_contact = true;
  effect.tissue = [](double e, std::span<const double> zone, Tissue& tissue) {
    if (zone.empty()) tissue.thickness_factor *= 1 + e;
    else tissue.zones.push_back({e, zone[0], zone[1]});
  };
  return effect;
}

}  // namespace palpate::shortcuts
