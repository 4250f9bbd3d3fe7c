// W = μ/(2 b) (exp(b (Ī1 − 3)) − 1).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/isochoric.hpp>

namespace palpate::materials {
namespace {

Response respond(const Mat3& F, std::span<const double> p, Asked asked) {
  const auto I1 = first_invariant(F, asked);
  const double mu = p[0], b = p[1], Q = b * (I1.value - 3);
  return from_one(I1, mu / (2 * b) * std::expm1(Q), mu / 2 * std::exp(Q), mu * b / 2 * std::exp(Q));
}

}  // namespace

Law fung_demiray() {
  return {{"material", "fung_demiray", "incompressible soft tissue that stiffens exponentially; the kidney paper's best law",
           "Demiray 1972, A note on the elasticity of soft biological tissues, J. Biomechanics 5:309, eq. 8",
           {{"mu", "MPa", {1e-9, 1e6}, 0.0067, "initial shear modulus"},
            {"b", "1", {1e-6, 1e3}, 1.0, "rate of stiffening"}}},
          Kinematics::finite, respond, [](std::span<const double> p) { return p[0]; }, incompressible};
}

}  // namespace palpate::materials
