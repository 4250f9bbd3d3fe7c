// From one time to another in steps that are halved when Newton fails and grow back when it does not.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

#include <solver/implicit/equilibrium.hpp>

namespace palpate::implicit {

struct StepPlan {
  std::vector<double> times;  ///< that are reported, s, ascending; the first one is where the state begins
  int most_cuts = 6;          ///< a step may be halved this often
};

/// A reported step.
struct Step {
  int index = 0;       ///< of its time; 0: where the state began
  const State& state;
  const Equations& equations;  ///< empty at index 0
  int iterations = 0;  ///< of Newton, all sub-steps together
  int cuts = 0;        ///< sub-steps that failed
  int drags = 0;       ///< sub-steps that were found by drag
};

/// A sub-step that is accepted.
struct Accepted {
  const State& state;
  const Equations& equations;
  bool by_drag = false;
};
using Observer = std::function<void(const Accepted&)>;

/// How far a plan has come, and how long its sub-steps are.
struct Stride {
  int done = -1;    ///< index of the last time that was reported
  double part = 1;  ///< of the time between two reports
  int easy = 0;     ///< sub-steps in a row that Newton found quickly: two of them earn a longer one
  bool pause = false;  ///< set while a time is reported: run_steps returns then
};

/// Calls `report` at every time of the plan after those of `stride`, `observe` (may be empty) after every sub-step. Returns the time reached:
/// the last one, or less when a step could not be made (equilibrium.trouble() says why).
double run_steps(Equilibrium& equilibrium, State& state, const StepPlan& plan, Stride& stride, const std::function<void(const Step&)>& report,
                 const Observer& observe = {});
/// From the beginning.
double run_steps(Equilibrium& equilibrium, State& state, const StepPlan& plan, const std::function<void(const Step&)>& report, const Observer& observe = {});

}  // namespace palpate::implicit
