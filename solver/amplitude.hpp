// How a load or a motion follows time: a factor, linear between points of a table and constant beyond them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <array>
#include <vector>

namespace palpate {

struct Amplitude {
  std::vector<std::array<double, 2>> points;  ///< time (s, ascending) and factor; none: the factor is the time itself

  double at(double time) const {
    if (points.empty()) return time;
    const auto after = std::upper_bound(points.begin(), points.end(), time, [](double t, const auto& p) { return t < p[0]; });
    if (after == points.begin()) return points.front()[1];
    if (after == points.end()) return points.back()[1];
    const auto before = after - 1;
    return (*before)[1] + (time - (*before)[0]) / ((*after)[0] - (*before)[0]) * ((*after)[1] - (*before)[1]);
  }
};

}  // namespace palpate
