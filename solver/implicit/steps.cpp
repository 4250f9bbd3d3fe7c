// Adaptive load steps.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/steps.hpp>

#include <algorithm>
#include <cmath>

namespace palpate::implicit {

double run_steps(Equilibrium& equilibrium, State& state, const StepPlan& plan, const std::function<void(const Step&)>& report) {
  const double whole = 1.0 / plan.count, smallest = whole / std::pow(2, plan.most_cuts);
  report({0, state, {}, 0, 0});
  double size = whole;
  int easy = 0;  // sub-steps in a row that Newton found quickly: two of them earn a longer one
  for (int index = 1; index <= plan.count; ++index) {
    const double target = index * whole;
    int iterations = 0, cuts = 0;
    Found last;
    while (state.load < target) {
      const bool to_target = state.load + 1.001 * size >= target;
      auto found = equilibrium.find(state, to_target ? target : state.load + size);
      if (found) {
        iterations += found->iterations;
        last = std::move(*found);
        easy = last.iterations <= 10 ? easy + 1 : 0;
        if (easy >= 2) size = std::min(whole, 2 * size);
      } else {
        size = std::min(size, target - state.load) / 2;
        ++cuts;
        easy = 0;
        if (size < smallest) return state.load;
      }
    }
    report({index, state, last.equations, iterations, cuts});
  }
  return state.load;
}

}  // namespace palpate::implicit
