// What is reported of a mini-element, and what its parts remember, once its bubble is solved.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/elements/sub_tetrahedra.hpp>

#include <cmath>

namespace palpate::elements {

using materials::Kinematics;
using materials::Mat3;

ElementResult mini_element_result(const Tetrahedron& rest, const Material& material, const ElementState& state) {
  ElementResult result;
  const SubTetrahedra subs = sub_tetrahedra(rest, state);
  for (int s = 0; s < 4; ++s) {
    const Mat3& F = subs[s].F;
    const bool small = material.law.kinematics == Kinematics::small;
    const double J = small ? F.trace() - 2 : F.determinant();
    const Mat3 P = respond(material, F, state, s).P;
    const Mat3 sigma = small ? P : Mat3(P * F.transpose() / J);
    const Mat3 deviator = sigma - sigma.trace() / 3 * Mat3::Identity();
    result.von_mises += 0.25 * std::sqrt(1.5) * deviator.norm();
    result.J += 0.25 * J;
  }
  return result;
}

void remember(const Tetrahedron& rest, const Material& material, const ElementState& state, double* memory) {
  const SubTetrahedra subs = sub_tetrahedra(rest, state);
  for (int s = 0; s < 4; ++s)
    material.remember({subs[s].F, state.history.time, state.history.dt, material.law.kinematics, start_of(state, s).modulus, state.known ? state.known + s : nullptr,
                       nullptr, materials::Asked::stress}, memory + s * material.memory());
}

}  // namespace palpate::elements
