// What is solved: organs of tetrahedra, what holds, loads and presses them over time. And the state of the solution.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <functional>
#include <vector>

#include <solver/contact/organ_friction.hpp>
#include <solver/contact/tool_contact.hpp>
#include <solver/elements/mini_tetrahedron.hpp>

namespace palpate::implicit {

/// u_component(node) = value (mm) · amplitude(time); component 3 is the pressure (MPa).
struct Prescribed {
  int node = 0;
  int component = 0;
  double value = 0;
  int amplitude = 0;  ///< index into Model::amplitudes
};

/// A dead force (N) · amplitude(time) on a node.
struct NodalForce {
  int node = 0;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  int amplitude = 0;
};

/// Pulls a node back to its rest position: N/mm in every direction.
struct Spring {
  int node = 0;
  double stiffness = 0;
};

/// A pressure (MPa) · amplitude(time) on faces, at right angles to them as they are now.
struct FacePressure {
  std::vector<int> faces;
  double value = 0;
  int amplitude = 0;
};

/// A layer on faces; it grows from nothing between t = −1 and 0.
struct Layer : effects::Active {
  std::vector<int> faces;
};

/// What holds or loads a region of the surface, shared among its nodes.
struct RegionForce : effects::Active {
  struct Point {
    int node = 0;
    double area = 0;         ///< at rest, mm²
    Eigen::Vector3d normal;  ///< at rest, unit
  };
  std::vector<Point> points;

  int memory() const { return effect.force.memory(parameters); }
};

struct Model {
  std::vector<Eigen::Vector3d> points;        ///< rest positions, mm
  std::vector<std::array<int, 4>> tets;       ///< positive volume
  std::vector<elements::Material> materials;
  std::vector<int> tet_material;              ///< one per tet: index into materials
  std::vector<std::array<effects::Start, 4>> starts;  ///< of every tet's sub-tetrahedra; none: as the materials say
  std::vector<std::array<int, 3>> faces;      ///< boundary, outward: where contact can happen
  std::vector<Amplitude> amplitudes{1};       ///< the first one is the time itself
  std::vector<Prescribed> prescribed;
  std::vector<NodalForce> nodal_forces;
  std::vector<FacePressure> pressures;
  std::vector<Spring> springs;
  std::vector<Layer> layers;
  std::vector<RegionForce> region_forces;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< m/s², times the materials' densities
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> body_force;  ///< N/mm³ at a rest position, besides gravity; may be empty
  int body_amplitude = 0;                     ///< of gravity and body force
  std::vector<contact::Tool> tools;
  std::vector<contact::Pass> passes;          ///< contact between organs
};

/// Unknowns node by node (u_x, u_y, u_z, p), bubbles tet by tet, contact pressures point by point.
struct State {
  Eigen::VectorXd nodal;
  std::vector<Eigen::Vector3d> bubbles;
  std::vector<double> contact_pressures;  ///< MPa; tool by tool, face by face, point by point
  std::vector<contact::Slip> slips;        ///< in the same order; none without friction
  std::vector<double> pair_pressures;      ///< MPa, of contact between organs; pass by pass, own face by own face, point by point
  std::vector<contact::PairSlip> pair_slips;  ///< in the same order; none without friction between organs
  Eigen::VectorXd before;                  ///< nodal, when the last step was found; none without friction between organs
  std::vector<double> travels;             ///< of every tool, mm; counts for those that are controlled by force
  std::vector<double> memory;             ///< of the materials' effects, tet by tet: see elements::History; then of region forces, point by point
  double memory_time = 0;                 ///< s: of the step before, which the memory is of
  double time = 0;                        ///< s

  Eigen::Vector3d displacement(int node) const { return nodal.segment<3>(4 * node); }
  double pressure(int node) const { return nodal(4 * node + 3); }
};

/// Of tools.
bool has_friction(const Model& model);

/// Between organs.
bool organs_rub(const Model& model);

bool has_force_control(const Model& model);

/// Whether effects on the stress are about, whose energy is not told by a state.
bool remembers(const Model& model);

/// How far layers have grown at a time, 0 to 1.
double grown_part(double time);

/// Whether every force has a potential, so that the tangent is symmetric.
bool is_conservative(const Model& model);

/// A tetrahedron of every face.
std::vector<int> tets_of_faces(const Model& model);

/// Of every face, MPa: A of contact's gap law (gap_law.hpp); between organs the softer one's counts.
std::vector<double> softness_of_faces(const Model& model);

/// Nodes of the faces around each node, itself too, ascending.
std::vector<std::vector<int>> nodes_around(const Model& model);

State rest_state(const Model& model);

/// Where a tool is.
contact::Pose pose(const Model& model, const State& state, int tool);

/// A face's corners with these nodal unknowns, with the state's, and at rest, mm.
std::array<Eigen::Vector3d, 3> corners_at(const Model& model, const Eigen::VectorXd& nodal, int face);
std::array<Eigen::Vector3d, 3> corners_now(const Model& model, const State& state, int face);
std::array<Eigen::Vector3d, 3> corners_at_rest(const Model& model, int face);
/// Of every face.
std::vector<contact::Triangle> faces_now(const Model& model, const State& state);
std::vector<contact::Triangle> faces_at_rest(const Model& model);

/// Where a tetrahedron's part of State::memory begins; one more entry, where that of region forces does.
std::vector<int> memory_starts(const Model& model);

/// Local unknowns of a tetrahedron; its memory begins at `memory_start`.
elements::ElementState element_state(const Model& model, const State& state, int tet, int memory_start = 0);

/// Corners of a tetrahedron at rest, columns, mm.
Eigen::Matrix<double, 3, 4> corners(const Model& model, const std::array<int, 4>& tet);

/// Centroid of a tetrahedron at rest, mm.
Eigen::Vector3d centroid(const Model& model, int tet);

}  // namespace palpate::implicit
