// Contact between organs in the equations: who meets whom, room for their blocks, their pressures and forces.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/assembly.hpp>

#include <algorithm>
#include <set>

namespace palpate::implicit {
namespace {

contact::Triangle corners_at_rest(const Model& model, int face) {
  return {model.points[model.faces[face][0]], model.points[model.faces[face][1]], model.points[model.faces[face][2]]};
}

}  // namespace

Assembly::Meetings Assembly::meetings_of(const State& state) const {
  Meetings meetings;
  if (model_.passes.empty()) return meetings;
  std::vector<contact::Triangle> rest, now;
  for (int f = 0; f < static_cast<int>(model_.faces.size()); ++f) {
    rest.push_back(corners_at_rest(model_, f));
    now.push_back(corners_now(model_, state, f));
  }
  for (const auto& pass : model_.passes) meetings.push_back(contact::meetings(pass, rest, now));
  return meetings;
}

/// Of the faces that meet, and of the other's neighbours: so a point may slide on without a new analysis of the pattern.
std::vector<std::array<int, 2>> Assembly::touching_nodes(const Meetings& meetings) const {
  std::vector<std::array<int, 2>> pairs;
  if (meetings.empty()) return pairs;
  std::set<std::array<int, 2>> faces, nodes;
  for (std::size_t p = 0; p < meetings.size(); ++p)
    for (const auto& meeting : meetings[p]) faces.insert({model_.passes[p].own[meeting.own], meeting.other});
  for (const auto& [own, other] : faces) {
    std::array<int, 6> six;
    std::copy(model_.faces[own].begin(), model_.faces[own].end(), six.begin());
    std::copy(model_.faces[other].begin(), model_.faces[other].end(), six.begin() + 3);
    for (int a : six)
      for (int b : six)
        if (b < a) nodes.insert({a, b});
    for (int a : model_.faces[own])
      for (int corner : model_.faces[other])
        for (int b : around_[corner])
          if (a != b) nodes.insert({std::max(a, b), std::min(a, b)});
  }
  return {nodes.begin(), nodes.end()};
}

void Assembly::add_organ_contact(const Meetings& meetings, const State& state, Equations& equations, BlockMatrix& tangent) const {
  auto& sums = equations.contact;
  std::size_t first = 0;  // of the pass' pressures
  std::vector<char> met(state.pair_pressures.size(), 0);
  for (std::size_t p = 0; p < meetings.size(); ++p) {
    const auto& pass = model_.passes[p];
    if (static_cast<int>(sums.organs.size()) <= pass.contact) sums.organs.resize(pass.contact + 1);
    const bool forward = p == 0 || model_.passes[p - 1].contact != pass.contact;
    for (const auto& meeting : meetings[p]) {
      const int own = pass.own[meeting.own];
      const std::size_t at = first + contact::points_per_face * meeting.own + meeting.q;
      const auto now = corners_now(model_, state, own), rest = corners_at_rest(model_, own);
      PairPlace place{at, {}, contact::pair_point(meeting, rest, now, corners_now(model_, state, meeting.other), state.pair_pressures[at],
                                                  std::min(softness_[own], softness_[meeting.other]))};
      met[at] = 1;
      sums.penetration = std::max(sums.penetration, -place.point.gap / contact::face_size(rest));
      sums.mismatch = std::max(sums.mismatch, place.point.mismatch);
      if (!(place.point.pressure > 0)) continue;
      for (int a = 0; a < 3; ++a) {
        place.nodes[a] = model_.faces[own][a];
        place.nodes[3 + a] = model_.faces[meeting.other][a];
      }
      add_pair(place, equations, tangent);
      equations.stored.contact += place.point.energy;
      const double area = contact::quadrature[meeting.q].weight * (now[1] - now[0]).cross(now[2] - now[0]).norm() / 2;
      sums.organs[pass.contact].area += area / 2;
      if (!pass.joined)
        for (int a = 0; a < 3; ++a) sums.organs[pass.contact].force -= (forward ? 1 : -1) * place.point.residual.segment<3>(3 * a);
      sums.pairs.push_back(std::move(place));
    }
    first += contact::points_per_face * pass.own.size();
  }
  for (std::size_t at = 0; at < met.size(); ++at)
    if (!met[at] && state.pair_pressures[at] > 0) sums.mismatch = std::max(sums.mismatch, 1.0);
}

void Assembly::add_pair(const PairPlace& place, Equations& equations, BlockMatrix& tangent) const {
  for (int a = 0; a < 6; ++a) {
    equations.residual.segment<3>(4 * place.nodes[a]) += place.point.residual.segment<3>(3 * a);
    for (int b = 0; b < 6; ++b) {
      if (place.nodes[b] > place.nodes[a]) continue;
      Block ab = Block::Zero(), ba = Block::Zero();
      ab.topLeftCorner<3, 3>() = place.point.tangent.block<3, 3>(3 * a, 3 * b);
      ba.topLeftCorner<3, 3>() = place.point.tangent.block<3, 3>(3 * b, 3 * a);
      if (a != b && place.nodes[a] == place.nodes[b]) tangent.add_both(place.nodes[a], place.nodes[a], ab, ab);  // both orders come by
      else tangent.add_both(place.nodes[a], place.nodes[b], ab, ba);
    }
  }
}

std::vector<double> Assembly::next_pair_pressures(const State& state, const ContactSums& contact, const Increment& step, double length) const {
  std::vector<double> pressures = state.pair_pressures;
  for (double& t : pressures) t *= 1 - length;  // of a point that is let go
  for (const auto& place : contact.pairs) {
    double opening = 0;
    for (int a = 0; a < 6; ++a) opening += place.point.gap_by_corners.segment<3>(3 * a).dot(step.nodal.segment<3>(4 * place.nodes[a]));
    const double before = state.pair_pressures[place.at], after = std::max(0.0, place.point.pressure - place.point.stiffness * opening);
    pressures[place.at] = before + length * (after - before);
  }
  return pressures;
}

}  // namespace palpate::implicit
