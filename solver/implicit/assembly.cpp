// Assembly in batches: elements in parallel, then added one after the other.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/assembly.hpp>

#include <algorithm>
#include <cmath>
#include <thread>

namespace palpate::implicit {
namespace {

/// Penalty over shear modulus: a pressure of 2 μ sinks 1 % of an element in; deeper is augmented. Five times as much makes Newton
/// chatter between sets of touching points.
constexpr double penalty_over_shear_modulus = 200;

/// f(i) for i in [begin, end), shared among threads.
template <class Function>
void in_parallel(int begin, int end, int threads, const Function& f) {
  const auto share = [&](int t) {
    for (int i = begin + t; i < end; i += threads) f(i);
  };
  std::vector<std::thread> workers;
  for (int t = 1; t < threads; ++t) workers.emplace_back(share, t);
  share(0);
  for (auto& worker : workers) worker.join();
}

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
    penalty_modulus_ = std::max(penalty_modulus_, penalty_over_shear_modulus * material.shear_modulus());
}

void Assembly::add_elements(State& state, Equations& equations, BlockMatrix& tangent) const {
  constexpr int batch = 4096;
  const int count = static_cast<int>(model_.tets.size());
  std::vector<elements::ElementSystem> systems(std::min(batch, count));
  double squares = 0;
  for (int begin = 0; begin < count; begin += batch) {
    const int end = std::min(begin + batch, count);
    in_parallel(begin, end, threads_, [&](int e) {
      auto local = element_state(model_, state, e);
      systems[e - begin] = elements::mini_element(rest_[e], model_.materials[model_.tet_material[e]], local, state.load * body_force_[e]);
      state.bubbles[e] = local.bubble;
    });
    for (int e = begin; e < end; ++e) {
      const auto& system = systems[e - begin];
      if (system.fault != elements::ElementFault::none) {
        equations.fault = system.fault;
        equations.faulty_tet = e;
        return;
      }
      squares += system.internal_force * system.internal_force;
      const auto& tet = model_.tets[e];
      for (int a = 0; a < 4; ++a) {
        equations.residual.segment<4>(4 * tet[a]) += system.residual.segment<4>(4 * a);
        for (int b = 0; b < 4; ++b)
          if (tet[b] <= tet[a]) tangent.add(tet[a], tet[b], system.tangent.block<4, 4>(4 * a, 4 * b));
      }
    }
  }
  equations.internal_force = std::sqrt(squares);
}

void Assembly::add_contact(const State& state, Equations& equations, BlockMatrix& tangent) const {
  const double travel = state.load * model_.tool->depth;
  auto& sums = equations.contact;
  sums.pressure.assign(state.multipliers.size(), 0.0);
  for (std::size_t f = 0; f < model_.faces.size(); ++f) {
    contact::Face face;
    const auto& nodes = model_.faces[f];
    for (int a = 0; a < 3; ++a) {
      face.rest[a] = model_.points[nodes[a]];
      face.now[a] = face.rest[a] + state.displacement(nodes[a]);
    }
    face.multipliers = &state.multipliers[contact::points_per_face * f];
    const auto contact = contact::face_contact(*model_.tool, travel, face, penalty_modulus_);
    sums.worst_gap = std::max(sums.worst_gap, contact.worst_gap);
    if (!contact.touched) continue;
    sums.force += contact.force;
    sums.area += contact.area;
    std::copy(contact.pressure.begin(), contact.pressure.end(), sums.pressure.begin() + contact::points_per_face * f);
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
  tangent.set_zero();
  add_elements(state, equations, tangent);
  if (equations.fault == elements::ElementFault::none && model_.tool) add_contact(state, equations, tangent);
  return equations;
}

std::vector<elements::ElementResult> Assembly::results(const State& state) const {
  std::vector<elements::ElementResult> results(model_.tets.size());
  in_parallel(0, static_cast<int>(model_.tets.size()), threads_, [&](int e) {
    results[e] = elements::mini_element_result(rest_[e], model_.materials[model_.tet_material[e]], element_state(model_, state, e));
  });
  return results;
}

}  // namespace palpate::implicit
