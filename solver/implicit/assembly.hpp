// The equations of a state: residual, tangent, contact, and what is wrong with it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/implicit/block_matrix.hpp>
#include <solver/implicit/conjugates.hpp>
#include <solver/implicit/model.hpp>
#include <solver/implicit/neighbourhood.hpp>

namespace palpate::implicit {

/// A tool's reaction.
struct ToolSums {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< of the tool on the organ, N
  double area = 0;                                  ///< mm²
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< on the organ about the tool's pivot, N mm
  Eigen::VectorXd by_travel;                        ///< ∂residual/∂(travel of the tool), N/mm
  Eigen::VectorXd by_angle;                         ///< ∂residual/∂(angle of the tool), N/rad; of a tool that turns
  Eigen::VectorXd along_by_nodes;                   ///< ∂(force along the axis)/∂(nodes), N/mm; of a tool controlled by force
  double excess = 0;                                ///< force along the axis above the one asked for, N; of a tool controlled by force
};

/// What two organs, or two parts of one, do to each other.
struct OrganSums {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< on the organ of the first pass, N; zero for an organ on itself
  double area = 0;                                  ///< of the faces that touch, mm²; half of what both passes see
};

/// A point of contact between organs, by its place in State::pair_pressures; nodes of its own face, then of the other.
struct PairPlace {
  std::size_t at = 0;
  std::array<int, 6> nodes;
  contact::PairPoint point;
  bool rubs = false;                  ///< friction there is
  contact::KnownCoulomb law;          ///< if so
  contact::PairSlip after;            ///< what friction remembers if the step is accepted
};

struct ContactSums {
  std::vector<ToolSums> tools;
  double penetration = 0, mismatch = 0;  ///< worst ones; see FaceContact
  int weakly_active = 0;                 ///< points that touch a tool without pressing
  std::vector<contact::Point> points;    ///< every contact point, as State::contact_pressures
  std::vector<OrganSums> organs;         ///< one per contact of the case
  std::vector<PairPlace> pairs;          ///< those that lie inside the other surface
};

/// A step of the unknowns: of the nodes, and of the tools controlled by force (0 for others).
struct Increment {
  Eigen::VectorXd nodal;
  std::vector<double> travels;
};

/// Energy of a state, N mm.
struct Stored {
  double tissue = 0;        ///< of laws without effects on the stress
  double layers = 0;        ///< as far as they have grown
  double grown_layers = 0;  ///< the same as if they were grown
  double springs = 0;
  double contact = 0;       ///< in the gaps that contact's pressures leave
};

struct Equations {
  Eigen::VectorXd residual;   ///< node by node: force (N) × 3, volume (mm³)
  Eigen::VectorXd tissue;     ///< the elements' part of it; only of tissue that remembers
  double internal_force = 0;  ///< root of the sum of squares of the terms that cancel, N
  Stored stored;
  ContactSums contact;
  std::vector<Eigen::VectorXd> pressure_forces;  ///< residuals of every face pressure at amplitude 1, N
  elements::ElementFault fault = elements::ElementFault::none;
  int faulty_tet = -1;
};

/// Assembles with rest shapes computed once. Elements are computed in parallel and added in the mesh's order: the same
/// bytes for any number of threads.
class Assembly {
 public:
  Assembly(const Model& model, int threads);

  /// Residual and tangent at `state` (its bubbles are solved in place). With a fault, neither is valid.
  /// `known`: is told what runs beside this one need to know.
  Equations operator()(State& state, BlockMatrix& tangent, Neighbourhood* known = nullptr) const;
  /// Residual and contact of a run close to the known one, at the same bubbles, which take a linear step. `shifts`: are told what its laws with other
  /// numbers say more; `scratch`: of the same pattern.
  Equations beside(State& state, const Neighbourhood& known, LawShifts& shifts, BlockMatrix& scratch) const;
  /// Loads and contact alone, of a run close to the known one.
  Equations without_tissue(const State& state, const Neighbourhood& known, BlockMatrix& scratch) const;
  /// The bubbles' answer to a small step of the nodes.
  void let_bubbles_follow(State& state, const Neighbourhood& known, const Eigen::VectorXd& step) const;
  /// Change of the residual at an unchanged shape when time goes on: loads grow, tools travel (to first order).
  Eigen::VectorXd change_by_time(const Equations& equations, double from, double to) const;
  /// Pressures of contact between organs after the same part of a step.
  std::vector<double> next_pair_pressures(const State& state, const ContactSums& contact, const Increment& step, double length) const;
  /// Contact pressures after a part `length` of the Newton step `step` from `state`, while time goes on to `time`.
  std::vector<double> next_pressures(const State& state, const ContactSums& contact, const Increment& step, double time, double length) const;
  /// Changes of a tool's force on the organ when the nodes of `state` change by each column of `steps`, to first order, N.
  Eigen::Matrix3Xd tool_force_changes(int tool, const State& state, const Eigen::MatrixXd& steps) const;
  /// Sum of gravity, body forces, nodal forces, pressures, springs and region forces on the organs, N.
  Eigen::Vector3d loads(const State& state) const;
  /// What does work on the organs, and where what can be lost goes; forces are zero of empty equations.
  Channels conjugates(const State& state, const Equations& equations) const;
  /// What friction's elastic slip stores, N mm.
  double stored_in_slips(const State& state) const;
  /// The tissue remembers `state`, which is accepted: its memory and memory_time become those of this state. `known`, `shifts`: of
  /// a run close beside.
  void remember(State& state, const Neighbourhood* known = nullptr, const LawShifts* shifts = nullptr) const;
  /// Von Mises stress and J of every tetrahedron.
  std::vector<elements::ElementResult> results(const State& state) const;

 private:
  using Meetings = std::vector<std::vector<contact::Meeting>>;  ///< pass by pass
  Equations empty_equations(const State& state) const;
  void add_elements(State& state, Equations& equations, BlockMatrix& tangent, Neighbourhood* known) const;
  std::vector<char> same_laws(const Neighbourhood& known) const;
  void add_rest(const Meetings& meetings, const State& state, Equations& equations, BlockMatrix& tangent, const Neighbourhood* beside = nullptr) const;
  void add_loads(const State& state, Equations& equations, BlockMatrix& tangent) const;
  void add_pressures(const State& state, Equations& equations, BlockMatrix& tangent) const;
  Eigen::Vector3d pressure_on_organs(const State& state) const;
  void add_layers(const State& state, Equations& equations, BlockMatrix& tangent) const;
  void add_region_forces(const State& state, Equations& equations, BlockMatrix& tangent, const Neighbourhood* beside) const;
  void learn_region_forces(const State& state, Neighbourhood& known) const;
  void learn_friction(const ContactSums& contact, Neighbourhood& known) const;
  Eigen::Vector3d region_forces_on_organs(const State& state) const;
  void remember_region_forces(const State& state, std::vector<double>& memory, const Neighbourhood* beside) const;
  void sum_up(int tool, const contact::FaceContact& contact, const std::array<int, 3>& nodes, const contact::Face& face,
              const contact::Pose& pose, ToolSums& sums) const;
  Meetings meetings_of(const State& state) const;
  std::vector<std::array<int, 2>> touching_nodes(const Meetings& meetings, const State& state) const;
  void add_organ_contact(const Meetings& meetings, const State& state, Equations& equations, BlockMatrix& tangent, const Neighbourhood* beside) const;
  Eigen::Vector3d add_shear(const contact::Pass& pass, const contact::Meeting& meeting, const State& state, PairPlace& place, Equations& equations, BlockMatrix& tangent,
                            const Neighbourhood* beside) const;
  void add_pair(const PairPlace& place, Equations& equations, BlockMatrix& tangent) const;
  std::size_t first_point(int tool, int face) const;
  Conjugates tool_conjugates(const State& state, const Equations& equations) const;
  Conjugates load_conjugates(const State& state, const Equations& equations) const;
  Conjugates support_conjugates(const State& state) const;
  Conjugates cling_conjugates(const State& state, const Equations& equations) const;
  Conjugates slip_conjugates(const State& state) const;
  double body_potential(const State& state) const;
  contact::Face face_at(int tool, int face, const State& state, const Neighbourhood* beside = nullptr) const;
  void add_contact(int tool, const State& state, Equations& equations, BlockMatrix& tangent, const Neighbourhood* beside) const;

  const Model& model_;
  int threads_;
  std::vector<elements::Tetrahedron> rest_;
  std::vector<elements::BodyForce> body_force_;
  std::vector<int> memory_starts_;
  std::vector<double> softness_;  ///< of every face, MPa, see contact::face_contact
  std::vector<std::vector<int>> around_;  ///< nodes of the faces around each node; none without contact between organs
};

}  // namespace palpate::implicit
