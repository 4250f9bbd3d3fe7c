// Slips of tools, then anchors between organs.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/slips.hpp>

#include <algorithm>

#include <solver/contact/coulomb.hpp>

namespace palpate::implicit {
namespace {

using Eigen::Vector3d;

void remember_of_tools(const Model& model, const std::vector<contact::Point>& points, State& state) {
  state.slips.resize(state.contact_pressures.size());
  std::size_t at = 0;
  for (std::size_t i = 0; i < model.tools.size(); ++i) {
    const auto& tool = model.tools[i];
    const auto now = pose(model, state, static_cast<int>(i));
    for (int f = 0; f < static_cast<int>(model.faces.size()); ++f) {
      const auto corners = corners_now(model, state, f);
      for (int q = 0; q < contact::points_per_face; ++q, ++at) {
        auto& slip = state.slips[at];
        const contact::Slip before = slip;
        slip = {contact::place(tool, now, corners, q), at < points.size() ? points[at].shear : Vector3d::Zero()};
        if (at < points.size() && points[at].slides) slip.shear *= 1 - contact::inside_the_cone;
        if (tool.turns()) slip.shear = tool.rotation(now.angle).transpose() * slip.shear;
        const bool moved_on = at < points.size() && (points[at].slides || !(points[at].pressure > 0));
        slip.place_before = moved_on ? before.place : slip.place;
        slip.shear_before = moved_on ? before.shear : slip.shear;
      }
    }
  }
}

/// Points that nothing presses hold on to nothing.
void remember_of_organs(const std::vector<PairPlace>& pairs, State& state) {
  state.before = state.nodal;
  state.pair_slips.resize(state.pair_pressures.size());
  for (auto& slip : state.pair_slips) slip = {-1, {}, Vector3d::Zero(), slip.way};
  for (const auto& place : pairs)
    if (place.rubs) state.pair_slips[place.at] = place.after;
}

}  // namespace

void remember_slips(const Model& model, const ContactSums& contact, State& state) {
  if (has_friction(model)) remember_of_tools(model, contact.points, state);
  if (organs_rub(model)) remember_of_organs(contact.pairs, state);
}

void anchor_again(const Model& model, const std::vector<contact::PairSlip>& carried, State& state) {
  remember_of_organs({}, state);
  const auto rest = faces_at_rest(model), now = faces_now(model, state);
  const auto softness = softness_of_faces(model);
  std::size_t first = 0;
  for (const auto& pass : model.passes) {
    if (pass.friction > 0)
      for (const auto& meeting : contact::meetings(pass, rest, now)) {
        const int own = pass.own[meeting.own];
        const std::size_t at = first + contact::points_per_face * meeting.own + meeting.q;
        const double stiffness = contact::slip_stiffness(rest[own], std::min(softness[own], softness[meeting.other]));
        state.pair_slips[at] = contact::anchored(meeting, now[own], now[meeting.other], carried[at].shear + stiffness * carried[at].beyond, stiffness);
      }
    first += contact::points_per_face * pass.own.size();
  }
}

}  // namespace palpate::implicit
