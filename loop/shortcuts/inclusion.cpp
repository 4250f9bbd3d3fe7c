// Inclusion: one site is stiffer by e s/(1 + s), s = contact radius over distance.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>
#include <algorithm>

namespace palpate::shortcuts {

Effect inclusion() {
  Effect effect;
  effect.entry = {"start", "inclusion", "something stiffer or softer lies under one site", "Eshelby 1957 (energy of an inclusion in the field of a point force)",
                  {{"excess", "1", {-0.95, 50}, 0.3, "stiffness at full influence, minus one"},
                     {"x", "mm", {-1e4, 1e4}, 0, "site above it"},
                     {"y", "mm", {-1e4, 1e4}, 0, "site above it"},
                     {"z", "mm", {-1e4, 1e4}, 0, "site above it"},
                     {"depth", "mm", {0.1, 100}, 10, "depth of its middle"}}};
  effect.accuracy = 0.2;
  effect.separates = "scan neighbouring sites";
  effect.refines = false;
  effect.needs_contact = true;
  effect.grid_of = [](const Set& set) {
    std::vector<Vec3> sites;
    for (const Run& run : set.runs)
      if (std::none_of(sites.begin(), sites.end(), [&](const Vec3& s) { return norm(s - run.point_mm) < 0.5; })) sites.push_back(run.point_mm);
    std::vector<std::vector<double>> grid;
    if (sites.size() > 1)  // with one site only, a part of it that differs is the tissue
      for (const Vec3& s : sites)
        for (double depth : {1.5, 5.0, 15.0}) grid.push_back({s[0], s[1], s[2], depth});
    return grid;
  };
  effect.tissue = [](double e, std::span<const double> shape, Tissue& tissue) {
    tissue.inclusions.push_back({{shape[0], shape[1], shape[2]}, e, shape[3]});
  };
  return effect;
}

}  // namespace palpate::shortcuts
