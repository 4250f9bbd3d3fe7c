// What a frame shows of a wall: stress, strain and thickness of each triangle.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/explicit/tissue.hpp>

namespace palpate::explicit_shell {

struct TriangleState {
  double von_mises = 0;   ///< MPa, Cauchy, the largest of the five layers
  double strain = 0;      ///< largest principal logarithmic strain of the five layers
  double thickness = 0;   ///< mm now: the rest thickness times the mean stretch of the layers
};
/// With what effects add to the law's stress, if any do.
std::vector<TriangleState> triangle_states(const Wall& wall, const WallState& state, const TissueForces* tissue = nullptr);

/// Value below which a part q of the area lies.
double area_quantile(const Wall& wall, const std::vector<TriangleState>& states, double TriangleState::*value, double q);

}  // namespace palpate::explicit_shell
