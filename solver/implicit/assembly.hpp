// The equations of a state: residual, tangent, contact, and what is wrong with it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/implicit/block_matrix.hpp>
#include <solver/implicit/model.hpp>

namespace palpate::implicit {

/// A tool's reaction.
struct ToolSums {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< of the tool on the organ, N
  double area = 0;                                  ///< mm²
  Eigen::VectorXd by_travel;                        ///< ∂residual/∂(travel of the tool), N/mm
};

struct ContactSums {
  std::vector<ToolSums> tools;
  double penetration = 0, mismatch = 0;  ///< worst ones; see FaceContact
  std::vector<contact::Point> points;    ///< every contact point, as State::contact_pressures
};

struct Equations {
  Eigen::VectorXd residual;   ///< node by node: force (N) × 3, volume (mm³)
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
  /// Change of the residual at an unchanged shape when time goes on: loads grow, tools travel (to first order).
  Eigen::VectorXd change_by_time(const Equations& equations, double from, double to) const;
  /// Contact pressures after a part `length` of the Newton step `step` from `state`, while time goes on to `time`.
  std::vector<double> next_pressures(const State& state, const ContactSums& contact, const Eigen::VectorXd& step, double time,
                                     double length) const;
  /// Sum of gravity, body forces, nodal forces and springs on the organs, N.
  Eigen::Vector3d loads(const State& state) const;
  /// Von Mises stress and J of every tetrahedron.
  std::vector<elements::ElementResult> results(const State& state) const;

 private:
  void add_elements(State& state, Equations& equations, BlockMatrix& tangent) const;
  void add_loads(const State& state, Equations& equations, BlockMatrix& tangent) const;
  void add_contact(int tool, const State& state, Equations& equations, BlockMatrix& tangent) const;

  const Model& model_;
  int threads_;
  std::vector<elements::Tetrahedron> rest_;
  std::vector<elements::BodyForce> body_force_;
  std::vector<double> softness_;  ///< of every face, MPa, see contact::face_contact
};

}  // namespace palpate::implicit
