// What solves say of one tool at one place.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include <palpate/vec3.hpp>

namespace palpate::loop {

/// A departure (departures.hpp) as solved over as the closed form has it: q₀ + q₁ x, x = depth over the deepest; 0 for one that the closed form does not follow, which then changes nothing.
struct SolvedChange {
  std::string of;
  double amplitude = 0;               ///< at which it was solved; 0: the null's own
  std::array<double, 2> factor{1, 0};
  double scatter = 0;                 ///< rms of the solved change about it, over the change
};

struct SiteCurve {
  std::string tool;
  Vec3 point_mm{0, 0, 0};
  double deepest_mm = 1;
  std::array<double, 3> factor{1, 0, 0};  ///< the smooth factor between solved and closed curve, c₀ + c₁ x + c₂ x²
  double scatter = 0;                     ///< rms of the solved factor about the smooth one, weighted by force: the mesh's own roughness
  double mesh_shift = 0;                  ///< logarithm of the force on a mesh that is twice as fine under the tool over that on the mesh itself: mean over depth,
  double mesh_apart = 0;                  ///< and rms about it; 0: not asked
  std::vector<double> mesh_depth_mm, mesh_change;  ///< this logarithm over depth: the direction in which the curve may be off
  int nodes = 0, solves = 0;
  std::vector<SolvedChange> changes;
};

}  // namespace palpate::loop
