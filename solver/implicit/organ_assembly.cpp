// Contact between organs in the equations: who meets whom, room for their blocks, their pressures and forces.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/assembly.hpp>

#include <algorithm>
#include <set>

namespace palpate::implicit {
Assembly::Meetings Assembly::meetings_of(const State& state) const {
  Meetings meetings;
  if (model_.passes.empty()) return meetings;
  const auto rest = faces_at_rest(model_), now = faces_now(model_, state);
  for (const auto& pass : model_.passes) meetings.push_back(contact::meetings(pass, rest, now));
  return meetings;
}

/// Of the faces that meet, and of the other's neighbours: so a point may slide on without a new analysis of the pattern. With friction, of the faces
/// of anchors too.
std::vector<std::array<int, 2>> Assembly::touching_nodes(const Meetings& meetings, const State& state) const {
  std::vector<std::array<int, 2>> pairs;
  if (meetings.empty()) return pairs;
  std::set<std::array<int, 3>> faces;  // own, other, anchor's
  std::set<std::array<int, 2>> nodes;
  std::size_t first = 0;
  for (std::size_t p = 0; p < meetings.size(); ++p) {
    const auto& pass = model_.passes[p];
    for (const auto& meeting : meetings[p]) {
      const int anchor = pass.friction > 0 ? state.pair_slips[first + contact::points_per_face * meeting.own + meeting.q].face : -1;
      faces.insert({pass.own[meeting.own], meeting.other, anchor < 0 ? meeting.other : anchor});
    }
    first += contact::points_per_face * pass.own.size();
  }
  for (const auto& three : faces) {
    std::array<int, 9> nine;
    for (int i = 0; i < 3; ++i) std::copy(model_.faces[three[i]].begin(), model_.faces[three[i]].end(), nine.begin() + 3 * i);
    for (int a : nine)
      for (int b : nine)
        if (b < a) nodes.insert({a, b});
    for (int a : model_.faces[three[0]])
      for (int corner : model_.faces[three[1]])
        for (int b : around_[corner])
          if (a != b) nodes.insert({std::max(a, b), std::min(a, b)});
  }
  return {nodes.begin(), nodes.end()};
}

void Assembly::add_organ_contact(const Meetings& meetings, const State& state, Equations& equations, BlockMatrix& tangent, const Neighbourhood* beside) const {
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
                                                  std::min(softness_[own], softness_[meeting.other])), false, {}, {}};
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
      Eigen::Vector3d force = Eigen::Vector3d::Zero();  // on the own face
      for (int a = 0; a < 3; ++a) force -= place.point.residual.segment<3>(3 * a);
      if (pass.friction > 0) force += add_shear(pass, meeting, state, place, equations, tangent, beside);
      if (!pass.joined) sums.organs[pass.contact].force += (forward ? 1 : -1) * force;
      sums.pairs.push_back(std::move(place));
    }
    first += contact::points_per_face * pass.own.size();
  }
  for (std::size_t at = 0; at < met.size(); ++at)
    if (!met[at] && state.pair_pressures[at] > 0) sums.mismatch = std::max(sums.mismatch, 1.0);
}

namespace {

/// Adds a matrix between nodes some of which may be the same; it has fewer rows than columns where rows are zero.
template <std::size_t count, int rows, int columns>
void add_blocks(const std::array<int, count>& nodes, const Eigen::Matrix<double, rows, columns>& matrix, BlockMatrix& tangent) {
  const auto block_of = [&](int a, int b) {
    Block block = Block::Zero();
    if (3 * a < rows) block.template topLeftCorner<3, 3>() = matrix.template block<3, 3>(3 * a, 3 * b);
    return block;
  };
  for (int a = 0; a < static_cast<int>(count); ++a)
    for (int b = 0; b < static_cast<int>(count); ++b) {
      if (nodes[b] > nodes[a]) continue;
      const Block ab = block_of(a, b);
      // Of two corners that are one node both orders come by.
      tangent.add_both(nodes[a], nodes[b], ab, a != b && nodes[a] == nodes[b] ? ab : block_of(b, a));
    }
}

}  // namespace

void Assembly::add_pair(const PairPlace& place, Equations& equations, BlockMatrix& tangent) const {
  for (int a = 0; a < 6; ++a) equations.residual.segment<3>(4 * place.nodes[a]) += place.point.residual.segment<3>(3 * a);
  add_blocks(place.nodes, place.point.tangent, tangent);
}

/// Returns the force on the own face, N.
Eigen::Vector3d Assembly::add_shear(const contact::Pass& pass, const contact::Meeting& meeting, const State& state, PairPlace& place, Equations& equations,
                                    BlockMatrix& tangent, const Neighbourhood* beside) const {
  const int own = pass.own[meeting.own];
  const auto& before = state.pair_slips[place.at];
  const int anchor = before.face < 0 ? meeting.other : before.face;
  const auto shear = contact::pair_shear(meeting, place.point, corners_at_rest(model_, own), corners_now(model_, state, own), corners_now(model_, state, meeting.other),
                                         {before, corners_now(model_, state, anchor), corners_at(model_, state.before, own), corners_at(model_, state.before, meeting.other)}, pass.friction, std::min(softness_[own], softness_[meeting.other]),
                                         beside && beside->on_organs.contains(place.at) ? &beside->on_organs.at(place.at) : nullptr);
  std::array<int, 9> nodes;
  std::copy(place.nodes.begin(), place.nodes.end(), nodes.begin());
  std::copy(model_.faces[anchor].begin(), model_.faces[anchor].end(), nodes.begin() + 6);
  for (int a = 0; a < 6; ++a) equations.residual.segment<3>(4 * nodes[a]) += shear.residual.segment<3>(3 * a);
  add_blocks(nodes, shear.tangent, tangent);
  place.rubs = true;
  place.law = shear.law;
  place.after = shear.after;
  return -(shear.residual.segment<3>(0) + shear.residual.segment<3>(3) + shear.residual.segment<3>(6));
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
