// Assembly in batches: every thread computes one and adds it when its turn comes, in the order of the mesh.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/assembly.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

#include <solver/implicit/parallel.hpp>

namespace palpate::implicit {
namespace {

/// Body force at the centroid of each sub-tetrahedron: three corners and the barycentre.
elements::BodyForce body_force_of(const Model& model, int tet) {
  constexpr double kg_per_m3 = 1e-9;  // in kg/mm³: times m/s², N/mm³
  elements::BodyForce force = (kg_per_m3 * model.materials[model.tet_material[tet]].density * model.gravity).replicate<1, 4>();
  if (!model.body_force) return force;
  const auto centroids = elements::sub_centroids(corners(model, model.tets[tet]));
  for (int s = 0; s < 4; ++s) force.col(s) += model.body_force(centroids.col(s));
  return force;
}

}  // namespace

Assembly::Assembly(const Model& model, int threads) : model_(model), threads_(threads), memory_starts_(memory_starts(model)) {
  for (int t = 0; t < static_cast<int>(model.tets.size()); ++t) {
    rest_.push_back(elements::tetrahedron(corners(model, model.tets[t])));
    body_force_.push_back(body_force_of(model, t));
  }
  if (!model.passes.empty()) around_ = nodes_around(model);
  if (model.tools.empty() && model.passes.empty()) return;
  softness_ = softness_of_faces(model);
}

/// Adding takes a sixth of computing or less: few threads seldom wait for their turn.
void Assembly::add_elements(State& state, Equations& equations, BlockMatrix& tangent, Neighbourhood* known) const {
  constexpr int batch = 64;  // its systems stay in a core's cache
  const int count = static_cast<int>(model_.tets.size());
  std::atomic<int> next_to_compute = 0, next_to_add = 0;
  const double ramp = model_.amplitudes[model_.body_amplitude].at(state.time);
  double squares = 0;
  const auto add = [&](int e, const elements::ElementSystem& system) {
    if (system.fault != elements::ElementFault::none) {
      equations.fault = system.fault;
      equations.faulty_tet = e;
      return;
    }
    squares += system.internal_force * system.internal_force;
    equations.stored.tissue += system.energy;
    for (int a = 0; a < 4; ++a) equations.residual.segment<4>(4 * model_.tets[e][a]) += system.residual.segment<4>(4 * a);
    tangent.add_tet(e, system.tangent);
  };
  on_threads(threads_, [&](int) {
    std::vector<elements::ElementSystem> systems(batch);
    for (int begin; (begin = next_to_compute.fetch_add(batch)) < count;) {
      const int end = std::min(begin + batch, count);
      for (int e = begin; e < end; ++e) {
        auto local = element_state(model_, state, e, memory_starts_[e]);
        if (known) local.learns = &known->laws[4 * e];
        systems[e - begin] = elements::mini_element(rest_[e], model_.materials[model_.tet_material[e]], local, ramp * body_force_[e],
                                                    known ? &known->condensations[e] : nullptr);
        state.bubbles[e] = local.bubble;
      }
      for (int turn; (turn = next_to_add.load()) != begin;) next_to_add.wait(turn);
      for (int e = begin; e < end && equations.fault == elements::ElementFault::none; ++e) add(e, systems[e - begin]);
      next_to_add.store(begin + batch);
      next_to_add.notify_all();
    }
  });
  equations.internal_force = std::sqrt(squares);
  if (remembers(model_)) equations.tissue = equations.residual;
}

void Assembly::add_loads(const State& state, Equations& equations, BlockMatrix& tangent) const {
  for (const auto& force : model_.nodal_forces)
    equations.residual.segment<3>(4 * force.node) -= model_.amplitudes[force.amplitude].at(state.time) * force.value;
  for (const auto& spring : model_.springs) {
    equations.residual.segment<3>(4 * spring.node) += spring.stiffness * state.displacement(spring.node);
    equations.stored.springs += spring.stiffness / 2 * state.displacement(spring.node).squaredNorm();
    Block block = Block::Zero();
    block.diagonal().head<3>().setConstant(spring.stiffness);
    tangent.add(spring.node, spring.node, block);
  }
}

/// Where a face's contact pressures begin in the state.
std::size_t Assembly::first_point(int tool, int face) const { return contact::points_per_face * (tool * model_.faces.size() + face); }

contact::Face Assembly::face_at(int index, int f, const State& state, const Neighbourhood* beside) const {
  contact::Face face;
  face.rest = corners_at_rest(model_, f);
  face.now = corners_now(model_, state, f);
  face.pressures = &state.contact_pressures[first_point(index, f)];
  if (!model_.tools[index].holds_on()) return face;
  face.slips = &state.slips[first_point(index, f)];
  if (beside && !beside->on_tools.empty()) face.branches = &beside->on_tools[first_point(index, f)];
  return face;
}

Eigen::Matrix3Xd Assembly::tool_force_changes(int index, const State& state, const Eigen::MatrixXd& steps) const {
  Eigen::Matrix3Xd changes = Eigen::Matrix3Xd::Zero(3, steps.cols());
  for (int f = 0; f < static_cast<int>(model_.faces.size()); ++f) {
    const auto contact = contact::face_contact(model_.tools[index], pose(model_, state, index), face_at(index, f, state), softness_[f]);
    if (!contact.touched) continue;
    for (int b = 0; b < 3; ++b) {
      Eigen::Matrix3d of_face = Eigen::Matrix3d::Zero();
      for (int a = 0; a < 3; ++a) of_face += contact.tangent.block<3, 3>(3 * a, 3 * b);
      changes -= of_face * steps.middleRows<3>(4 * model_.faces[f][b]);
    }
  }
  return changes;
}

/// A face's part in what the tool feels, and in how it changes with the tool's place. Only the place of face and tool against each other
/// counts: ∂r/∂travel = −K_contact · (a rigid motion along the axis); in a turn the forces turn too.
void Assembly::sum_up(int index, const contact::FaceContact& contact, const std::array<int, 3>& nodes, const contact::Face& face,
                      const contact::Pose& pose, ToolSums& own) const {
  const contact::Tool& tool = model_.tools[index];
  const Eigen::Vector3d pivot = tool.pivot_now(pose);
  own.force += contact.force;
  own.area += contact.area;
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector3d residual = contact.residual.segment<3>(3 * a);
    own.moment -= (face.now[a] - pivot).cross(residual);
    if (tool.turns()) own.by_angle.segment<3>(4 * nodes[a]) += tool.spin.cross(residual);
    for (int b = 0; b < 3; ++b) {
      const Eigen::Matrix3d block = contact.tangent.block<3, 3>(3 * a, 3 * b);
      own.by_travel.segment<3>(4 * nodes[a]) -= block * tool.axis;
      if (tool.turns()) own.by_angle.segment<3>(4 * nodes[a]) -= block * tool.spin.cross(face.now[b] - pivot);
      if (tool.force_controlled) own.along_by_nodes.segment<3>(4 * nodes[b]) -= block.transpose() * tool.axis;
    }
  }
}

void Assembly::add_contact(int index, const State& state, Equations& equations, BlockMatrix& tangent, const Neighbourhood* beside) const {
  const contact::Tool& tool = model_.tools[index];
  const contact::Pose now = pose(model_, state, index);
  auto& sums = equations.contact;
  auto& own = sums.tools[index];
  own.by_travel = Eigen::VectorXd::Zero(state.nodal.size());
  if (tool.turns()) own.by_angle = own.by_travel;
  if (tool.force_controlled) own.along_by_nodes = own.by_travel;
  for (std::size_t f = 0; f < model_.faces.size(); ++f) {
    const auto& nodes = model_.faces[f];
    const contact::Face face = face_at(index, f, state, beside);
    const auto contact = contact::face_contact(tool, now, face, softness_[f]);
    sums.penetration = std::max(sums.penetration, contact.penetration);
    sums.mismatch = std::max(sums.mismatch, contact.mismatch);
    sums.weakly_active += contact.weakly_active;
    if (!contact.touched) continue;
    equations.stored.contact += contact.energy;
    sum_up(index, contact, nodes, face, now, own);
    std::copy(contact.points.begin(), contact.points.end(), sums.points.begin() + first_point(index, f));
    for (int a = 0; a < 3; ++a) {
      equations.residual.segment<3>(4 * nodes[a]) += contact.residual.segment<3>(3 * a);
      for (int b = 0; b < 3; ++b) {
        if (nodes[b] > nodes[a]) continue;
        Block block = Block::Zero(), other = Block::Zero();
        block.topLeftCorner<3, 3>() = contact.tangent.block<3, 3>(3 * a, 3 * b);
        other.topLeftCorner<3, 3>() = contact.tangent.block<3, 3>(3 * b, 3 * a);
        if (tangent.symmetric()) tangent.add(nodes[a], nodes[b], block);
        else tangent.add_both(nodes[a], nodes[b], block, other);
      }
    }
  }
  if (tool.force_controlled) own.excess = own.force.dot(tool.axis) - tool.force * tool.ramp.at(state.time);
}

Equations Assembly::empty_equations(const State& state) const {
  Equations equations;
  equations.residual = Eigen::VectorXd::Zero(state.nodal.size());
  equations.contact.tools.resize(model_.tools.size());
  equations.contact.points.assign(state.contact_pressures.size(), {});
  return equations;
}

Equations Assembly::operator()(State& state, BlockMatrix& tangent, Neighbourhood* known) const {
  Equations equations = empty_equations(state);
  const auto meetings = meetings_of(state);
  tangent.extend(touching_nodes(meetings, state));
  tangent.set_zero(threads_);
  if (known) {
    known->parameters.clear();
    for (const auto& material : model_.materials) known->parameters.push_back(material.parameters);
    known->laws.resize(4 * model_.tets.size());
    known->condensations.resize(model_.tets.size());
    learn_region_forces(state, *known);
  }
  add_elements(state, equations, tangent, known);
  if (equations.fault == elements::ElementFault::none) add_rest(meetings, state, equations, tangent);
  if (known) learn_friction(equations.contact, *known);
  return equations;
}

/// All but the elements.
void Assembly::add_rest(const Meetings& meetings, const State& state, Equations& equations, BlockMatrix& tangent, const Neighbourhood* beside) const {
  add_loads(state, equations, tangent);
  add_pressures(state, equations, tangent);
  add_layers(state, equations, tangent);
  add_region_forces(state, equations, tangent, beside);
  for (int i = 0; i < static_cast<int>(model_.tools.size()); ++i) add_contact(i, state, equations, tangent, beside);
  add_organ_contact(meetings, state, equations, tangent, beside);
}

Eigen::VectorXd Assembly::change_by_time(const Equations& equations, double from, double to) const {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(equations.residual.size());
  for (std::size_t i = 0; i < model_.tools.size(); ++i) {
    const auto& tool = model_.tools[i];
    const auto& sums = equations.contact.tools[i];
    if (!tool.force_controlled) change += (tool.travel(to) - tool.travel(from)) * sums.by_travel;
    if (tool.turns()) change += (tool.turn.at(to) - tool.turn.at(from)) * sums.by_angle;
  }
  for (std::size_t i = 0; i < model_.pressures.size(); ++i) {
    const auto& grows = model_.amplitudes[model_.pressures[i].amplitude];
    change += (grows.at(to) - grows.at(from)) * equations.pressure_forces[i];
  }
  for (const auto& force : model_.nodal_forces) {
    const auto& ramp = model_.amplitudes[force.amplitude];
    change.segment<3>(4 * force.node) -= (ramp.at(to) - ramp.at(from)) * force.value;
  }
  const auto& ramp = model_.amplitudes[model_.body_amplitude];
  const double growth = ramp.at(to) - ramp.at(from);
  if (growth != 0)
    for (std::size_t e = 0; e < model_.tets.size(); ++e)  // without the bubbles' share: good enough to predict
      for (int a = 0; a < 4; ++a)
        for (int s = 0; s < 4; ++s)
          change.segment<3>(4 * model_.tets[e][a]) -= growth * rest_[e].volume / 4 * elements::mean_weight(a, s) * body_force_[e].col(s);
  return change;
}

std::vector<double> Assembly::next_pressures(const State& state, const ContactSums& contact, const Increment& step, double time, double length) const {
  auto pressures = state.contact_pressures;
  for (std::size_t i = 0; i < model_.tools.size(); ++i) {
    const auto& tool = model_.tools[i];
    const double travel = tool.force_controlled ? step.travels[i] : tool.travel(time) - tool.travel(state.time);
    const Eigen::Vector3d motion = travel * tool.axis, turn = (tool.turn.at(time) - tool.turn.at(state.time)) * tool.spin;
    const Eigen::Vector3d pivot = tool.pivot_now(pose(model_, state, static_cast<int>(i)));
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
      std::array<Eigen::Vector3d, 3> corner_steps;
      for (int a = 0; a < 3; ++a) {
        const int node = model_.faces[f][a];
        corner_steps[a] = step.nodal.segment<3>(4 * node) - motion;
        if (tool.turns()) corner_steps[a] -= turn.cross(model_.points[node] + state.displacement(node) - pivot);
      }
      for (int q = 0; q < contact::points_per_face; ++q) {
        const std::size_t at = contact::points_per_face * (i * model_.faces.size() + f) + q;
        pressures[at] = contact::next_pressure(contact.points[at], q, pressures[at], corner_steps, length);
      }
    }
  }
  return pressures;
}

Eigen::Vector3d Assembly::loads(const State& state) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t e = 0; e < model_.tets.size(); ++e) sum += rest_[e].volume / 4 * body_force_[e].rowwise().sum();
  sum *= model_.amplitudes[model_.body_amplitude].at(state.time);
  for (const auto& force : model_.nodal_forces) sum += model_.amplitudes[force.amplitude].at(state.time) * force.value;
  sum += pressure_on_organs(state) + region_forces_on_organs(state);
  for (const auto& spring : model_.springs) sum -= spring.stiffness * state.displacement(spring.node);
  return sum;
}

void Assembly::remember(State& state, const Neighbourhood* known, const LawShifts* shifts) const {
  const std::vector<char> same = known ? same_laws(*known) : std::vector<char>(model_.materials.size(), 0);
  std::vector<double> memory = state.memory;
  in_shares(static_cast<int>(model_.tets.size()), threads_, [&](int from, int to) {
    for (int e = from; e < to; ++e)
      if (memory_starts_[e + 1] > memory_starts_[e]) {
        auto local = element_state(model_, state, e, memory_starts_[e]);
        std::array<materials::KnownLaw, 4> shifted;
        if (same[model_.tet_material[e]]) local.known = &known->laws[4 * e];
        else if (known && shifts && !shifts->empty()) {
          for (int s = 0; s < 4; ++s) shifted[s] = materials::shifted(known->laws[4 * e + s], (*shifts)[4 * e + s]);
          local.known = shifted.data();
        }
        elements::remember(rest_[e], model_.materials[model_.tet_material[e]], local, &memory[memory_starts_[e]]);
      }
  });
  remember_region_forces(state, memory, known);
  state.memory = std::move(memory);
  state.memory_time = state.time;
}

std::vector<elements::ElementResult> Assembly::results(const State& state) const {
  std::vector<elements::ElementResult> results(model_.tets.size());
  in_shares(static_cast<int>(model_.tets.size()), threads_, [&](int from, int to) {
    for (int e = from; e < to; ++e) {
      auto local = element_state(model_, state, e, memory_starts_[e]);
      local.asked = materials::Asked::stress;
      results[e] = elements::mini_element_result(rest_[e], model_.materials[model_.tet_material[e]], local);
    }
  });
  return results;
}

}  // namespace palpate::implicit
