// A state carried to another mesh of the same rest shape: nodes are material points of the old mesh, cells know their parents there.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <solver/implicit/model.hpp>

namespace palpate::implicit {

/// Where a new mesh comes from.
struct Origins {
  std::vector<std::array<int, 4>> nodes;       ///< of every new node: old nodes,
  std::vector<std::array<double, 4>> weights;  ///< and how much of each; they sum to 1
  std::vector<int> tets;                       ///< the old tetrahedron that a new one lies in
  std::vector<int> faces;                      ///< the old face that a new one lies in; −1: there was none
};

/// Displacements and pressures by the weights; what sub-tetrahedra remember from that of the parent which holds their centroid; contact from the
/// parent's nearest point; a bed's slip by the weights. Bubbles are zero: an equilibrium is to be found again.
State carried(const Model& old_model, const State& old_state, const Model& model, const Origins& origins);

/// Volume of the deformed organs, mm³.
double volume(const Model& model, const State& state);

}  // namespace palpate::implicit
