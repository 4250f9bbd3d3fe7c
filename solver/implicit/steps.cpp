// Adaptive steps in time.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/steps.hpp>

#include <algorithm>
#include <cmath>

namespace palpate::implicit {

namespace {

/// A smaller step is cheaper than drag; where this many do not help, the organ is about to jump. Between two reports once there, and once more
/// where nothing else is left, nearer to the trouble: drag is dear.
constexpr int cuts_before_drag = 3;

}  // namespace

double run_steps(Equilibrium& equilibrium, State& state, const StepPlan& plan, Stride& stride, const std::function<void(const Step&)>& report,
                 const Observer& observe) {
  if (stride.done < 0) {
    state.time = plan.times.front();
    stride.done = 0;
    report({0, state, {}, 0, 0, 0});
  }
  auto& [done, part, easy, pause] = stride;
  for (int index = done + 1; index < static_cast<int>(plan.times.size()); ++index) {
    const double target = plan.times[index], whole = target - plan.times[index - 1];
    int iterations = 0, cuts = 0, drags = 0;
    Found last;
    while (state.time < target) {
      const bool to_target = state.time + 1.001 * part * whole >= target;
      const double next = to_target ? target : state.time + part * whole;
      const double halved = std::min(part, (target - state.time) / whole) / 2;
      const bool last_chance = halved < std::pow(2.0, -plan.most_cuts);
      auto found = equilibrium.find(state, next);
      const bool by_newton = found.has_value();
      if (!found && (cuts == std::min(cuts_before_drag, plan.most_cuts) || last_chance)) {
        found = equilibrium.find_by_drag(state, next);
        drags += found.has_value();
      }
      if (found) {
        iterations += found->iterations;
        last = std::move(*found);
        if (observe) observe({state, last.equations, !by_newton});
        easy = last.iterations <= 10 ? easy + 1 : 0;
        if (easy >= 2) part = std::min(1.0, 2 * part);
      } else {
        part = halved;
        ++cuts;
        easy = 0;
        if (last_chance) return state.time;
      }
    }
    done = index;
    report({index, state, last.equations, iterations, cuts, drags});
    if (pause) break;
  }
  return state.time;
}

double run_steps(Equilibrium& equilibrium, State& state, const StepPlan& plan, const std::function<void(const Step&)>& report,
                 const Observer& observe) {
  Stride stride;
  return run_steps(equilibrium, state, plan, stride, report, observe);
}

}  // namespace palpate::implicit
