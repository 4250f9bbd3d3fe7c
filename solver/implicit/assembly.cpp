// Assembly in batches: every thread computes one and adds it when its turn comes, in the order of the mesh.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/assembly.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

#include <solver/implicit/parallel.hpp>

namespace palpate::implicit {
namespace {

/// A pressure of 2 μ takes half of the penetration that is allowed.
constexpr double softness_over_shear_modulus = 2;

Eigen::Matrix<double, 3, 4> corners(const Model& model, const std::array<int, 4>& tet) {
  Eigen::Matrix<double, 3, 4> X;
  for (int a = 0; a < 4; ++a) X.col(a) = model.points[tet[a]];
  return X;
}

/// Body force at the centroid of each sub-tetrahedron: three corners and the barycentre.
elements::BodyForce body_force_of(const Model& model, const std::array<int, 4>& tet) {
  elements::BodyForce force = elements::BodyForce::Zero();
  if (!model.body_force) return force;
  const auto X = corners(model, tet);
  const Eigen::Vector3d sum = X.rowwise().sum();
  for (int s = 0; s < 4; ++s) force.col(s) = model.body_force((sum - X.col(s) + sum / 4) / 4);
  return force;
}

}  // namespace

Assembly::Assembly(const Model& model, int threads) : model_(model), threads_(threads) {
  for (const auto& tet : model.tets) {
    rest_.push_back(elements::tetrahedron(corners(model, tet)));
    body_force_.push_back(body_force_of(model, tet));
  }
  for (const auto& material : model.materials)
    contact_softness_ = std::max(contact_softness_, softness_over_shear_modulus * material.shear_modulus());
}

/// Adding takes a sixth of computing or less: few threads seldom wait for their turn.
void Assembly::add_elements(State& state, Equations& equations, BlockMatrix& tangent) const {
  constexpr int batch = 64;  // its systems stay in a core's cache
  const int count = static_cast<int>(model_.tets.size());
  std::atomic<int> next_to_compute = 0, next_to_add = 0;
  double squares = 0;
  const auto add = [&](int e, const elements::ElementSystem& system) {
    if (system.fault != elements::ElementFault::none) {
      equations.fault = system.fault;
      equations.faulty_tet = e;
      return;
    }
    squares += system.internal_force * system.internal_force;
    for (int a = 0; a < 4; ++a) equations.residual.segment<4>(4 * model_.tets[e][a]) += system.residual.segment<4>(4 * a);
    tangent.add_tet(e, system.tangent);
  };
  on_threads(threads_, [&](int) {
    std::vector<elements::ElementSystem> systems(batch);
    for (int begin; (begin = next_to_compute.fetch_add(batch)) < count;) {
      const int end = std::min(begin + batch, count);
      for (int e = begin; e < end; ++e) {
        auto local = element_state(model_, state, e);
        systems[e - begin] = elements::mini_element(rest_[e], model_.materials[model_.tet_material[e]], local, state.load * body_force_[e]);
        state.bubbles[e] = local.bubble;
      }
      for (int turn; (turn = next_to_add.load()) != begin;) next_to_add.wait(turn);
      for (int e = begin; e < end && equations.fault == elements::ElementFault::none; ++e) add(e, systems[e - begin]);
      next_to_add.store(begin + batch);
      next_to_add.notify_all();
    }
  });
  equations.internal_force = std::sqrt(squares);
}

void Assembly::add_contact(const State& state, Equations& equations, BlockMatrix& tangent) const {
  const double travel = state.load * model_.tool->depth;
  auto& sums = equations.contact;
  sums.points.assign(state.contact_pressures.size(), {});
  for (std::size_t f = 0; f < model_.faces.size(); ++f) {
    contact::Face face;
    const auto& nodes = model_.faces[f];
    for (int a = 0; a < 3; ++a) {
      face.rest[a] = model_.points[nodes[a]];
      face.now[a] = face.rest[a] + state.displacement(nodes[a]);
    }
    face.pressures = &state.contact_pressures[contact::points_per_face * f];
    const auto contact = contact::face_contact(*model_.tool, travel, face, contact_softness_);
    sums.penetration = std::max(sums.penetration, contact.penetration);
    sums.mismatch = std::max(sums.mismatch, contact.mismatch);
    if (!contact.touched) continue;
    sums.force += contact.force;
    sums.area += contact.area;
    std::copy(contact.points.begin(), contact.points.end(), sums.points.begin() + contact::points_per_face * f);
    for (int a = 0; a < 3; ++a) {
      equations.residual.segment<3>(4 * nodes[a]) += contact.residual.segment<3>(3 * a);
      for (int b = 0; b < 3; ++b) {
        // Only the place of face and tool against each other counts: ∂r/∂travel = −K_contact · (a rigid motion along the axis).
        equations.by_travel.segment<3>(4 * nodes[a]) -= contact.tangent.block<3, 3>(3 * a, 3 * b) * model_.tool->axis;
        if (nodes[b] > nodes[a]) continue;
        Block block = Block::Zero();
        block.topLeftCorner<3, 3>() = contact.tangent.block<3, 3>(3 * a, 3 * b);
        tangent.add(nodes[a], nodes[b], block);
      }
    }
  }
}

Equations Assembly::operator()(State& state, BlockMatrix& tangent) const {
  Equations equations;
  equations.residual = Eigen::VectorXd::Zero(state.nodal.size());
  equations.by_travel = Eigen::VectorXd::Zero(state.nodal.size());
  tangent.set_zero(threads_);
  add_elements(state, equations, tangent);
  if (equations.fault == elements::ElementFault::none && model_.tool) add_contact(state, equations, tangent);
  return equations;
}

std::vector<double> Assembly::next_pressures(const State& state, const ContactSums& contact, const Eigen::VectorXd& step, double travel,
                                             double length) const {
  auto pressures = state.contact_pressures;
  if (!model_.tool) return pressures;
  for (std::size_t f = 0; f < model_.faces.size(); ++f) {
    std::array<Eigen::Vector3d, 3> corner_steps;
    for (int a = 0; a < 3; ++a) corner_steps[a] = step.segment<3>(4 * model_.faces[f][a]) - travel * model_.tool->axis;
    for (int q = 0; q < contact::points_per_face; ++q) {
      const std::size_t i = contact::points_per_face * f + q;
      pressures[i] = contact::next_pressure(contact.points[i], q, pressures[i], corner_steps, length);
    }
  }
  return pressures;
}

std::vector<elements::ElementResult> Assembly::results(const State& state) const {
  std::vector<elements::ElementResult> results(model_.tets.size());
  in_shares(static_cast<int>(model_.tets.size()), threads_, [&](int from, int to) {
    for (int e = from; e < to; ++e)
      results[e] = elements::mini_element_result(rest_[e], model_.materials[model_.tet_material[e]], element_state(model_, state, e));
  });
  return results;
}

}  // namespace palpate::implicit
