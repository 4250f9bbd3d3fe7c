// Where a mesh does not suit what happens to it: faces that a tool touches against the tool's curvature there, elements that have lost their shape, and
// where a step stopped.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <solver/implicit/assembly.hpp>

namespace palpate {

/// [remesh] of a case.
struct RemeshRules {
  double part_of_radius = 0.5;  ///< edges of faces that a tool touches are at most this part of the tool's radius of curvature there
  double part_of_contact = 0.35;  ///< and at most this part of half the contact's width
  double least_shape = 0.3;     ///< an element's mean ratio is at least this part of that at rest
  double finest_mm = 0;         ///< no edge is asked to be shorter; half of it where a step stopped
  int most = 8;                 ///< remeshings in a run
  int most_nodes = 20000;       ///< a mesh of more is not made finer
};

/// Mean ratio of a tetrahedron with these corners, 12 (3 V)^(2/3) / Σ l²: 1 regular, 0 flat, negative inverted. (Liu and Joe 1994, BIT 34:268.)
double mean_ratio(const Eigen::Matrix<double, 3, 4>& x);

/// For each tetrahedron its mean ratio now, of that at rest.
std::vector<double> shapes(const implicit::Model& model, const implicit::State& state);

/// What is asked of a mesh, and why.
struct Marks {
  std::vector<double> longest_mm;  ///< for each tetrahedron the longest edge it should have, 0 for no wish; empty: the mesh is fine
  std::string why;
};

/// The mesh against the tools that touch it and against what has become of its elements.
Marks marks(const implicit::Model& model, const implicit::State& state, const implicit::ContactSums& contact, const RemeshRules& rules);

/// Half the edges around a place of the rest shape where a step stopped. Empty: they are at their finest.
std::vector<double> trouble_marks(const implicit::Model& model, const implicit::State& state, const Eigen::Vector3d& place_mm, const RemeshRules& rules);

/// Half of the mean edge of the surface.
double default_finest(const implicit::Model& model);

}  // namespace palpate
