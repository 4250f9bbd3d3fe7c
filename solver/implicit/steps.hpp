// From no load to full load in steps that are halved when Newton fails and grow back when it does not.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include <solver/implicit/equilibrium.hpp>

namespace palpate::implicit {

struct StepPlan {
  int count = 20;     ///< steps of equal load that are reported
  int most_cuts = 6;  ///< a step may be halved this often
};

/// A reported step.
struct Step {
  int index = 0;       ///< 0: rest
  const State& state;
  const Equations& equations;
  int iterations = 0;  ///< of Newton, all sub-steps together
  int cuts = 0;        ///< sub-steps that failed
};

/// Calls `report` at rest and at every multiple of 1/count. Returns the load reached: 1, or less when a step could not be made
/// (equilibrium.trouble() says why).
double run_steps(Equilibrium& equilibrium, State& state, const StepPlan& plan, const std::function<void(const Step&)>& report);

}  // namespace palpate::implicit
