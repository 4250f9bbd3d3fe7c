// What a result of palpate-solve measures: geometry and quality of its mesh at rest, maxima of what was solved.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <pipeline/report/study.hpp>

namespace palpate {

struct Measure {
  std::string group;     ///< "geometry", "mesh", "maxima", "trust"
  std::string quantity;  ///< "wall's area"
  std::string unit;      ///< "mm²", "1"
  double value = 0;
};

struct Measured {
  std::string name;
  Solve solve;
  std::vector<Measure> measures;             ///< each quantity at most once
  std::vector<double> arc_mm, diameter_mm;   ///< of a tube's mid-surface along its centre line; empty for a solid
};

/// Geometry and mesh quality come from the first frame, stresses from the deepest one, forces from the history; 99.5 % values by area or
/// volume. Throws Failure(unreadable) naming the file: no frames, or one that is damaged.
Measured measure(const std::string& name, Solve solve);

}  // namespace palpate
