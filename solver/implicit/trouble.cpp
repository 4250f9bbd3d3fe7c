// Why no equilibrium was found: what stopped Newton's method, or what is more telling.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/equilibrium.hpp>

#include <algorithm>
#include <cmath>

namespace palpate::implicit {
namespace {

/// A tool that advances by more than this part of an element in a step is likely too fast; an organ that gives way this many times as fast as
/// at first is likely near a limit point.
constexpr double too_fast = 0.5, steep = 4;

const char* words(elements::ElementFault fault) {
  switch (fault) {
    case elements::ElementFault::inverted:
      return "an element would turn inside out: try smaller steps, a finer or better mesh there, or less depth";
    case elements::ElementFault::bubble_not_positive:
      return "an element lost its stiffness (the law is not convex at this strain): try less depth or a law that stiffens";
    case elements::ElementFault::bubble_not_converged:
      return "an element's interior found no equilibrium: try smaller steps or a better mesh there";
    case elements::ElementFault::none: break;
  }
  return "";
}

}  // namespace

void Equilibrium::explain_fault(const Equations& equations) {
  const bool inverted = equations.fault == elements::ElementFault::inverted;
  trouble_ = {words(equations.fault) + std::string(" (tetrahedron ") + std::to_string(equations.faulty_tet) + ")",
              centroid(model_, equations.faulty_tet), inverted ? Cause::element_inverted : Cause::law_not_stable};
}

void Equilibrium::explain_singular() {
  trouble_ = {"the equations are singular: is the organ held? try a larger base", model_.points.front(), Cause::unknown};
}

void Equilibrium::explain_residual(const Trial& trial) {
  if (trouble_.likely == Cause::element_inverted) return;  // what shortened the last step tells more
  int worst = 0;
  double largest = -1;
  for (int node = 0; node < static_cast<int>(model_.points.size()); ++node)
    for (int c = 0; c < 3; ++c)
      if (!fixed_[4 * node + c] && std::abs(trial.equations.residual(4 * node + c)) > largest) {
        largest = std::abs(trial.equations.residual(4 * node + c));
        worst = node;
      }
  trouble_ = {"Newton's method does not settle (largest unbalanced force here): try smaller steps, a finer mesh under the tool, or less depth",
              model_.points[worst], Cause::unknown};
}

/// A tool that advances by more than an element and has lost the organ it touched, or was about to touch: it is on the other side.
bool Equilibrium::jumped_through(const State& before, const Trial& after) {
  const std::size_t points = contact::points_per_face * model_.faces.size();
  for (std::size_t i = 0; i < model_.tools.size(); ++i) {
    const auto& tool = model_.tools[i];
    const double from = pose(model_, before, static_cast<int>(i)).travel, to = pose(model_, after.state, static_cast<int>(i)).travel;
    const auto touches = [&](const State& state) {
      const auto first = state.contact_pressures.begin() + i * points;
      return std::any_of(first, first + points, [](double t) { return t > 0; });
    };
    if (to > from + element_size_ && (from == 0 || touches(before)) && !touches(after.state)) {
      trouble_ = {"the tool advances and touches the organ no more: it jumped through or slipped off; try smaller steps",
                  tool.first_contact, Cause::tool_too_fast};
      return true;
    }
  }
  return false;
}

/// Nothing says where a free body is: any place is an equilibrium.
bool Equilibrium::drifts(const State& state) {
  for (const auto& body : free_bodies_)
    if (!touched(model_, state, body)) {
      trouble_ = {"a body is held by nothing, and nothing touches it", body.place_mm, Cause::body_not_held};
      return true;
    }
  return false;
}

/// Looks for what is more telling than what stopped Newton's method.
void Equilibrium::explain_stop(const State& from, double time) {
  if (trouble_.likely == Cause::body_not_held || trouble_.likely == Cause::tool_too_fast) return;
  for (const auto& body : free_bodies_)
    if (!touched(model_, from, body)) {
      trouble_ = {"a body can move freely (" + std::to_string(body.motions) + " of 6 rigid motions) and nothing touched it: hold it by [base], [[spring]] or "
                  "[[displacement]], or bring it into contact by smaller steps", body.place_mm, Cause::body_not_held};
      return;
    }
  for (std::size_t i = 0; i < model_.tools.size(); ++i) {
    const auto& tool = model_.tools[i];
    const double way = std::abs(tool.travel(time) - tool.travel(from.time));
    if (tool.force_controlled || way <= too_fast * element_size_) continue;
    trouble_.cause += "; the tool advances by " + std::to_string(way) + " mm in this step, " + std::to_string(way / element_size_) +
                      " of an element: slower, or more steps";
    trouble_.likely = Cause::tool_too_fast;
    return;
  }
  if (rates_.size() < 2 || !(rates_.back() > steep * rates_.front())) return;
  trouble_.cause += "; the organ gave way " + std::to_string(rates_.back() / rates_.front()) +
                    " times as fast as at first: the load may be beyond a limit point; try less of it, or control the motion instead";
  trouble_.likely = Cause::beyond_limit_point;
}

}  // namespace palpate::implicit
