// Bodies that nothing holds: the rank of what is prescribed and sprung against the six rigid motions of each body.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <solver/implicit/model.hpp>

namespace palpate::implicit {

/// A body that can move as a whole without anything but contact resisting.
struct FreeBody {
  std::vector<char> nodes;  ///< 1 for its nodes
  Eigen::Vector3d place_mm = Eigen::Vector3d::Zero();  ///< its middle at rest
  int motions = 0;                                     ///< how many of six are free
};

/// Bodies are tetrahedra joined by nodes.
std::vector<FreeBody> free_bodies(const Model& model);

/// Whether a tool or another organ touches the body.
bool touched(const Model& model, const State& state, const FreeBody& body);

}  // namespace palpate::implicit
