// Equilibrium by drag: r(u) + c (u − u_k) = 0 for u_{k+1}, with c → 0: implicit Euler along the organ's own slow motion.
// Kelley and Keyes 1998, SIAM J. Numer. Anal. 35:508 (pseudo-transient continuation).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/equilibrium.hpp>

namespace palpate::implicit {
namespace {

constexpr int most_moves = 100;
/// Iterations after which a stronger drag is cheaper, and up to which a move was easy.
constexpr int quick = 12, quickly = 6;
/// Of a drag, in parts of an element's stiffness: where it begins, where it is as good as none, where it does not help.
constexpr double first = 0.1, least = 1e-4, most = 1e4;
/// Residual that ends a move, and below which the drag is let go.
constexpr double settled = 1e-5, close = 1e-6;

}  // namespace

/// Moves the trial along until little drag is left; false where even a strong drag does not hold it.
bool Equilibrium::drag_along(Trial& trial) {
  double drag = first;
  int easy = 0;  // moves in a row
  bool failed = false;
  for (int move = 0; move < most_moves && drag < most; ++move) {
    drag_ = {drag * stiffness_scale_, trial.state.nodal};
    Trial next = trial;
    next.iterations = 0;
    next.equations = assemble(next.state);
    const bool sound = next.equations.fault == elements::ElementFault::none;
    if (!sound) explain_fault(next.equations);
    if (!sound || !newton(next, {quick, settled}) || !stable(next)) {
      drag *= 4;
      easy = 0;
      failed = true;
      continue;
    }
    const int iterations = trial.iterations + next.iterations;
    easy = next.iterations <= quickly ? easy + 1 : 0;
    const double pull = drag_.stiffness * (next.state.nodal - trial.state.nodal).norm();
    trial = std::move(next);
    trial.iterations = iterations;
    if (pull <= close * (trial.equations.internal_force + force_floor_) || drag < least) return true;
    if (easy >= (failed ? 2 : 1)) drag /= 4;
  }
  return false;
}

std::optional<Found> Equilibrium::find_by_drag(State& state, double time) {
  const Trouble without = trouble_;
  Trial trial = trial_from(state, time);
  trial.state.time = time;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const bool moved = drag_along(trial);
    drag_ = {};
    if (!moved) break;
    Trial free = trial;
    free.equations = assemble(free.state);
    free.iterations = 0;
    if (!newton(free, limits_) || !stable(free)) continue;
    auto found = accept(free, state);
    if (!found) break;
    found->iterations += trial.iterations;
    return found;
  }
  trouble_ = without;
  return {};
}

}  // namespace palpate::implicit
