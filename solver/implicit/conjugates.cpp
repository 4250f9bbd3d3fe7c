// What does work on the organs: tools by their travel and turn, held nodes, loads, supports, growth of layers; and what takes it: slip against
// a tool, adhesion, tissue that remembers.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/assembly.hpp>

#include <algorithm>

namespace palpate::implicit {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Grows by blocks of three.
struct Gathered {
  std::vector<double> force, place;

  void add(const Vector3d& f, const Vector3d& x) {
    force.insert(force.end(), f.begin(), f.end());
    place.insert(place.end(), x.begin(), x.end());
  }
  Conjugates conjugates() const {
    return {Eigen::Map<const VectorXd>(force.data(), force.size()), Eigen::Map<const VectorXd>(place.data(), place.size())};
  }
};

/// Area at rest of a point of a face, mm².
double point_area(const Model& model, int face, int q) {
  const auto& nodes = model.faces[face];
  const Vector3d twice = (model.points[nodes[1]] - model.points[nodes[0]]).cross(model.points[nodes[2]] - model.points[nodes[0]]);
  return contact::quadrature[q].weight * twice.norm() / 2;
}

double size_of_face(const Model& model, int face) {
  const auto& nodes = model.faces[face];
  return contact::face_size({model.points[nodes[0]], model.points[nodes[1]], model.points[nodes[2]]});
}

/// Calls `visit` with a point's own face, its anchor's, its number there, and what it remembers.
template <class Visit>
void for_each_pair_slip(const Model& model, const State& state, const Visit& visit) {
  std::size_t at = 0;
  for (const auto& pass : model.passes)
    for (int own : pass.own)
      for (int q = 0; q < contact::points_per_face && !state.pair_slips.empty(); ++q, ++at) visit(own, state.pair_slips[at].face, q, state.pair_slips[at]);
}

}  // namespace

Conjugates Assembly::tool_conjugates(const State& state, const Equations& equations) const {
  const int count = static_cast<int>(model_.tools.size());
  Conjugates pairs{VectorXd::Zero(2 * count), VectorXd::Zero(2 * count)};
  for (int i = 0; i < count; ++i) {
    const auto now = pose(model_, state, i);
    pairs.place.segment<2>(2 * i) << now.travel, now.angle;
    if (equations.contact.tools.empty()) continue;
    const auto& sums = equations.contact.tools[i];
    pairs.force.segment<2>(2 * i) << sums.force.dot(model_.tools[i].axis), sums.moment.dot(model_.tools[i].spin);
  }
  return pairs;
}

/// Σ f · (u + bubble) over the organs, N mm: what body force does at amplitude 1.
double Assembly::body_potential(const State& state) const {
  double sum = 0;
  for (std::size_t e = 0; e < model_.tets.size(); ++e)
    for (int s = 0; s < 4; ++s) {
      Vector3d mean = state.bubbles[e] / 4;
      for (int a = 0; a < 4; ++a) mean += elements::mean_weight(a, s) * state.displacement(model_.tets[e][a]);
      sum += rest_[e].volume / 4 * body_force_[e].col(s).dot(mean);
    }
  return sum;
}

/// Nodal forces and pressures by the displacements; then body force, by its amplitude.
Conjugates Assembly::load_conjugates(const State& state, const Equations& equations) const {
  const long size = state.nodal.size();
  Conjugates pairs{VectorXd::Zero(size + 1), VectorXd::Zero(size + 1)};
  pairs.place.head(size) = state.nodal;
  pairs.place(size) = body_potential(state);
  if (equations.residual.size() == 0) return pairs;
  for (const auto& force : model_.nodal_forces)
    pairs.force.segment<3>(4 * force.node) += model_.amplitudes[force.amplitude].at(state.time) * force.value;
  for (std::size_t i = 0; i < model_.pressures.size(); ++i)
    pairs.force.head(size) -= model_.amplitudes[model_.pressures[i].amplitude].at(state.time) * equations.pressure_forces[i];
  pairs.force(size) = model_.amplitudes[model_.body_amplitude].at(state.time);
  return pairs;
}

Conjugates Assembly::support_conjugates(const State& state) const {
  Gathered pairs;
  std::size_t first = memory_starts_.back();
  for (const auto& bed : model_.region_forces) {
    const auto size = static_cast<std::size_t>(bed.memory());
    for (const auto& point : bed.points) {
      const Vector3d u = state.displacement(point.node);
      pairs.add(point.area * bed.effect.force.respond({u, point.normal}, {state.memory.data() + first, size}, bed.parameters).traction, u);
      first += size;
    }
  }
  return pairs.conjugates();
}

/// Seen from the tool, and of organs from each other; what they lose there.
Conjugates Assembly::slip_conjugates(const State& state) const {
  Gathered pairs;
  for (int i = 0; i < static_cast<int>(model_.tools.size()); ++i)
    for (int f = 0; f < static_cast<int>(model_.faces.size()) && model_.tools[i].holds_on(); ++f)
      for (int q = 0; q < contact::points_per_face; ++q) {
        const auto& slip = state.slips[first_point(i, f) + q];
        pairs.add(-point_area(model_, f, q) * slip.shear, slip.place);
      }
  for_each_pair_slip(model_, state, [&](int own, int, int q, const contact::PairSlip& slip) { pairs.add(-point_area(model_, own, q) * slip.shear, slip.way); });
  return pairs.conjugates();
}

double Assembly::stored_in_slips(const State& state) const {
  double sum = 0;
  for (int i = 0; i < static_cast<int>(model_.tools.size()); ++i)
    for (int f = 0; f < static_cast<int>(model_.faces.size()) && model_.tools[i].holds_on(); ++f) {
      const double softness = contact::deepest_gap * size_of_face(model_, f) / softness_[f];  // mm/MPa
      for (int q = 0; q < contact::points_per_face; ++q) sum += point_area(model_, f, q) * softness / 2 * state.slips[first_point(i, f) + q].shear.squaredNorm();
    }
  for_each_pair_slip(model_, state, [&](int own, int other, int q, const contact::PairSlip& slip) {
    if (other < 0) return;
    const double stiffness = contact::slip_stiffness(corners_at_rest(model_, own), std::min(softness_[own], softness_[other]));
    sum += point_area(model_, own, q) / stiffness / 2 * slip.shear.squaredNorm();
  });
  return sum;
}

Conjugates Assembly::cling_conjugates(const State& state, const Equations& equations) const {
  Gathered pairs;
  for (int i = 0; i < static_cast<int>(model_.tools.size()); ++i) {
    const auto& tool = model_.tools[i];
    const auto now = pose(model_, state, i);
    const Eigen::Matrix3d back = tool.turns() ? Eigen::Matrix3d(tool.rotation(now.angle).transpose()) : Eigen::Matrix3d::Identity();
    for (int f = 0; f < static_cast<int>(model_.faces.size()) && tool.reach() > 0; ++f) {
      const auto corners = corners_now(model_, state, f);
      for (int q = 0; q < contact::points_per_face; ++q) {
        const Vector3d cling = equations.contact.points.empty() ? Vector3d::Zero() : equations.contact.points[first_point(i, f) + q].cling;
        pairs.add(-point_area(model_, f, q) * (back * cling), contact::place(tool, now, corners, q));
      }
    }
  }
  return pairs.conjugates();
}

Channels Assembly::conjugates(const State& state, const Equations& equations) const {
  Channels all;
  const auto of = [&](Channel channel) -> Conjugates& { return all[static_cast<int>(channel)]; };
  const bool found = equations.residual.size() > 0;
  of(Channel::tools) = tool_conjugates(state, equations);
  Conjugates& held = of(Channel::held);
  held = {VectorXd::Zero(model_.prescribed.size()), VectorXd::Zero(model_.prescribed.size())};
  for (std::size_t i = 0; i < model_.prescribed.size(); ++i) {
    const auto& p = model_.prescribed[i];
    if (p.component == 3) continue;
    held.place(i) = state.nodal(4 * p.node + p.component);
    if (found) held.force(i) = equations.residual(4 * p.node + p.component);
  }
  of(Channel::loads) = load_conjugates(state, equations);
  of(Channel::supports) = support_conjugates(state);
  of(Channel::growth) = {VectorXd::Constant(1, equations.stored.grown_layers), VectorXd::Constant(1, grown_part(state.time))};
  of(Channel::friction) = slip_conjugates(state);
  of(Channel::adhesion) = cling_conjugates(state, equations);
  if (!remembers(model_)) return all;
  // The elements' residual is what they resist less the body force, whose work goes through the bubbles too.
  Conjugates& tissue = of(Channel::tissue) = of(Channel::loads);
  tissue.force.head(state.nodal.size()) = found ? equations.tissue : VectorXd(VectorXd::Zero(state.nodal.size()));
  for (long i = 3; i < state.nodal.size(); i += 4) tissue.force(i) = 0;
  return all;
}

}  // namespace palpate::implicit
