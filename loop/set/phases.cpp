// Phases from the sign and size of du/dt.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/set/phases.hpp>

#include <algorithm>
#include <cmath>

namespace palpate::loop {

std::vector<std::string> derived_phases(const Run& run) {
  const std::size_t n = run.t.size();
  const double rest = run.test == Test::indentation || run.test == Test::simple_shear ? 0 : 1;
  std::vector<double> away(n), rate(n, 0);
  for (std::size_t i = 0; i < n; ++i) away[i] = run.test == Test::indentation ? run.u[i] : std::abs(run.u[i] - rest);
  double fastest = 0, farthest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t low = i < 2 ? 0 : i - 2, high = std::min(i + 2, n - 1);
    const double dt = run.t[high] - run.t[low];
    if (dt > 0) rate[i] = (away[high] - away[low]) / dt;
    fastest = std::max(fastest, std::abs(rate[i]));
    farthest = std::max(farthest, away[i]);
  }
  std::vector<std::string> phases(n, "hold");
  for (std::size_t i = 0; i < n; ++i) {
    if (std::abs(rate[i]) > 0.02 * fastest)
      phases[i] = rate[i] > 0 ? "load" : "unload";
    else if (away[i] < farthest / 3)
      phases[i] = "rest";
  }
  return phases;
}

}  // namespace palpate::loop
