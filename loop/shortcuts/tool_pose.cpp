// Pose of the tool: a shaft tilted by α carries the lateral force F tan α, which turns with the tool.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/register.hpp>

#include <cmath>

namespace palpate::shortcuts {

Effect tool_pose() {
  Effect effect;
  effect.entry = {"tool", "tool_pose", "the tool is tilted: it is pushed aside, the other way round when it is turned", "statics: a force along a tilted shaft has a lateral part F tan(tilt)",
                  {{"tilt", "rad", {-0.5, 0.5}, 0.02, "angle between the tool and its axis"},
                     {"angle", "deg", {0.1, 360}, 90, "where it leans, from x towards y, before the tool is turned"}}};
  effect.separates = "turn the tool by 180 degrees (turn_deg = 180) and repeat, with lateral forces Fx, Fy";
  effect.grid = {{22.5}, {67.5}, {112.5}, {157.5}};
  effect.needs_contact = true;
  effect.known = [](const Set& set) -> std::string {
    if (set.specimen.shape != "block" && set.specimen.shape != "cylinder") return "on a curved surface a lateral force is no sign of it";
    for (const Run& run : set.runs)
      if (!run.Fx.empty() && run.Fx.size() == run.Fy.size()) return "";
    return "no lateral forces Fx, Fy are recorded";
  };
  effect.lateral = [](const Run& run, double e, std::span<const double> shape) -> std::array<double, 2> {
    const double angle = (shape[0] + run.turn_deg) * M_PI / 180;
    return {std::tan(e) * std::cos(angle), std::tan(e) * std::sin(angle)};
  };
  return effect;
}

}  // namespace palpate::shortcuts
