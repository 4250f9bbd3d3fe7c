// Equations of a run close beside a known one: elements by their residuals alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/assembly.hpp>

#include <algorithm>

#include <solver/implicit/parallel.hpp>

namespace palpate::implicit {

/// Of every material: whether its law's numbers are those that the known law answered for.
std::vector<char> Assembly::same_laws(const Neighbourhood& known) const {
  std::vector<char> same;
  for (std::size_t m = 0; m < model_.materials.size(); ++m) same.push_back(!known.laws.empty() && known.parameters[m] == model_.materials[m].parameters);
  return same;
}

Equations Assembly::beside(State& state, const Neighbourhood& known, LawShifts& shifts, BlockMatrix& scratch) const {
  const std::vector<char> same = same_laws(known);
  if (remembers(model_) && std::count(same.begin(), same.end(), 0)) shifts.resize(known.laws.size());
  const double ramp = model_.amplitudes[model_.body_amplitude].at(state.time);
  std::vector<elements::Vec16> residuals(model_.tets.size());
  in_shares(static_cast<int>(model_.tets.size()), threads_, [&](int from, int to) {
    for (int e = from; e < to; ++e) {
      auto local = element_state(model_, state, e, memory_starts_[e]);
      local.asked = materials::Asked::stress;
      std::array<materials::KnownLaw, 4> own;
      if (same[model_.tet_material[e]]) local.known = &known.laws[4 * e];
      else local.learns = own.data();
      residuals[e] = elements::residual_beside(rest_[e], model_.materials[model_.tet_material[e]], local, ramp * body_force_[e], known.condensations[e]);
      state.bubbles[e] = local.bubble;
      if (local.learns && !shifts.empty())
        for (int s = 0; s < 4; ++s) shifts[4 * e + s] = materials::shift(own[s], known.laws[4 * e + s]);
    }
  });
  Equations equations = without_tissue(state, known, scratch);
  for (std::size_t e = 0; e < residuals.size(); ++e)
    for (int a = 0; a < 4; ++a) equations.residual.segment<4>(4 * model_.tets[e][a]) += residuals[e].segment<4>(4 * a);
  return equations;
}

Equations Assembly::without_tissue(const State& state, const Neighbourhood& known, BlockMatrix& scratch) const {
  Equations equations = empty_equations(state);
  const auto meetings = meetings_of(state);
  scratch.extend(touching_nodes(meetings, state));
  add_rest(meetings, state, equations, scratch, &known);
  return equations;
}

void Assembly::learn_friction(const ContactSums& contact, Neighbourhood& known) const {
  using enum contact::Branch;
  known.on_tools.clear();
  known.on_organs.clear();
  if (has_friction(model_))
    for (const auto& point : contact.points) known.on_tools.push_back(point.pressure > 0 ? point.slides ? slides : sticks : by_bound);
  for (const auto& place : contact.pairs)
    if (place.rubs) known.on_organs.emplace(place.at, place.law);
}

void Assembly::let_bubbles_follow(State& state, const Neighbourhood& known, const Eigen::VectorXd& step) const {
  for (std::size_t e = 0; e < model_.tets.size(); ++e) {
    elements::Vec16 of_nodes;
    for (int a = 0; a < 4; ++a) of_nodes.segment<4>(4 * a) = step.segment<4>(4 * model_.tets[e][a]);
    state.bubbles[e] -= known.condensations[e].inverse * (known.condensations[e].columns.transpose() * of_nodes);
  }
}

}  // namespace palpate::implicit
