// The equations of a state: residual, tangent, contact, and what is wrong with it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/implicit/block_matrix.hpp>
#include <solver/implicit/model.hpp>

namespace palpate::implicit {

struct ContactSums {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< of the tool on the organ, N
  double area = 0;                                  ///< mm²
  double worst_gap = 0;                             ///< of the local element size; see FaceContact
  std::vector<double> pressure;                     ///< t of every contact point, MPa
};

struct Equations {
  Eigen::VectorXd residual;   ///< node by node: force (N) × 3, volume (mm³)
  Eigen::VectorXd by_travel;  ///< ∂residual/∂(travel of the tool), N/mm
  double internal_force = 0;  ///< root of the sum of squares of the terms that cancel, N
  ContactSums contact;
  elements::ElementFault fault = elements::ElementFault::none;
  int faulty_tet = -1;
};

/// Assembles with rest shapes computed once. Elements are computed in parallel and added in the mesh's order: the same
/// bytes for any number of threads.
class Assembly {
 public:
  Assembly(const Model& model, int threads);

  /// Residual and tangent at `state` (its bubbles are solved in place). With a fault, neither is valid.
  Equations operator()(State& state, BlockMatrix& tangent) const;
  /// Von Mises stress and J of every tetrahedron.
  std::vector<elements::ElementResult> results(const State& state) const;

 private:
  void add_elements(State& state, Equations& equations, BlockMatrix& tangent) const;
  void add_contact(const State& state, Equations& equations, BlockMatrix& tangent) const;

  const Model& model_;
  int threads_;
  std::vector<elements::Tetrahedron> rest_;
  std::vector<elements::BodyForce> body_force_;
  double penalty_modulus_ = 0;
};

}  // namespace palpate::implicit
