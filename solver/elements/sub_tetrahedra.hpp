// The four parts of a mini-element, as the material sees them: F_s = I + Σ u_a ⊗ ∇N_a + 4 b ⊗ ∇N_s, p_s = Σ_a w_sa p_a.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include <solver/elements/mini_tetrahedron.hpp>
#include <solver/elements/turgor.hpp>

namespace palpate::elements {

struct SubTetrahedron {
  materials::Mat3 F;
  double p = 0;
};

using SubTetrahedra = std::array<SubTetrahedron, 4>;

inline effects::Start start_of(const ElementState& state, int sub) { return state.starts ? state.starts[sub] : effects::Start{}; }

/// A sub-tetrahedron as the material sees it.
inline materials::Response respond(const Material& material, const materials::Mat3& F, const ElementState& state, int sub) {
  const auto& history = state.history;
  const auto [modulus, turgor] = start_of(state, sub);
  const materials::KnownLaw* known = state.known ? state.known + sub : nullptr;
  materials::KnownLaw* learns = state.learns ? state.learns + sub : nullptr;
  materials::Response r = material.effects.empty()
                   ? material.respond(F, modulus, known, learns, state.asked)
                   : material.respond({F, history.time, history.dt, material.law.kinematics, modulus, known, learns, state.asked}, history.memory + sub * material.memory());
  if (turgor != 0) add_turgor(r, F, turgor, material.law.kinematics, state.asked);
  return r;
}

/// Of all sub-tetrahedra: the pressure is the element's.
inline double mean_modulus(const ElementState& state) {
  double sum = 0;
  for (int s = 0; s < 4; ++s) sum += start_of(state, s).modulus;
  return sum / 4;
}

inline SubTetrahedra sub_tetrahedra(const Tetrahedron& rest, const ElementState& state) {
  materials::Mat3 F = materials::Mat3::Identity();
  Eigen::Vector4d p;
  for (int a = 0; a < 4; ++a) {
    F += state.nodal.segment<3>(4 * a) * rest.gradients.col(a).transpose();
    p(a) = state.nodal(4 * a + 3);
  }
  SubTetrahedra subs;
  for (int s = 0; s < 4; ++s) {
    subs[s].F = F + 4 * state.bubble * rest.gradients.col(s).transpose();
    for (int a = 0; a < 4; ++a) subs[s].p += mean_weight(a, s) * p(a);
  }
  return subs;
}

}  // namespace palpate::elements
