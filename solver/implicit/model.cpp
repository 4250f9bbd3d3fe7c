// Gathering an element's unknowns.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/model.hpp>

namespace palpate::implicit {

State rest_state(const Model& model) {
  State state;
  state.nodal = Eigen::VectorXd::Zero(4 * model.points.size());
  state.bubbles.assign(model.tets.size(), Eigen::Vector3d::Zero());
  state.contact_pressures.assign(contact::points_per_face * model.faces.size() * model.tools.size(), 0.0);
  return state;
}

elements::ElementState element_state(const Model& model, const State& state, int tet) {
  elements::ElementState local;
  for (int a = 0; a < 4; ++a) local.nodal.segment<4>(4 * a) = state.nodal.segment<4>(4 * model.tets[tet][a]);
  local.bubble = state.bubbles[tet];
  return local;
}

Eigen::Vector3d centroid(const Model& model, int tet) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int node : model.tets[tet]) sum += model.points[node];
  return sum / 4;
}

}  // namespace palpate::implicit
