// What a force owes to the motion of the tool: rate and friction.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/forward/backbone.hpp>
#include <loop/forward/effect.hpp>

namespace palpate::loop {

/// Times 1 + m sign(v) ln(1 + |v|/v0), v the speed over `scale` in 1/s.
void add_rate(const Run& run, const Tissue& tissue, const Path& depth, double scale, Path& force);

/// F (1 + 3π/16 μ a/R s) where all of the contact slips; s follows the motion elastically over 5 % of the depth and slips at ±1 (stop operator). An incompressible tissue
/// hardly moves along a ball: F (1 + solved_friction s), and s turns over 29 μ² of the logarithm of depth (decision 043).
void add_friction(const Site& site, const Tissue& tissue, const Path& depth, Path& force);

}  // namespace palpate::loop
