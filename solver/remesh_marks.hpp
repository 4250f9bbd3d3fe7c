// Where a mesh is too coarse for what happens to it: faces that a tool touches against the tool's curvature there, and where a step stopped.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <solver/implicit/assembly.hpp>

namespace palpate {

/// [remesh] of a case.
struct RemeshRules {
  double part_of_radius = 0.5;  ///< edges of faces that a tool touches are at most this part of the tool's radius of curvature there
  double finest_mm = 0;         ///< no edge is asked to be shorter; half of it where a step stopped
  int most = 8;                 ///< remeshings in a run
  int most_nodes = 20000;       ///< a mesh of more is not made finer
};

/// For each tetrahedron the longest edge it should have (mm), 0 for no wish. Empty: the mesh is fine.
std::vector<double> contact_marks(const implicit::Model& model, const implicit::State& state, const implicit::ContactSums& contact, const RemeshRules& rules);

/// Half the edges around a place of the rest shape where a step stopped. Empty: they are at their finest.
std::vector<double> trouble_marks(const implicit::Model& model, const implicit::State& state, const Eigen::Vector3d& place_mm, const RemeshRules& rules);

/// Half of the mean edge of the surface.
double default_finest(const implicit::Model& model);

}  // namespace palpate
