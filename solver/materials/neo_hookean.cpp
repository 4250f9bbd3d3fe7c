// W = μ/2 (Ī1 − 3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/isochoric.hpp>

namespace palpate::materials {
namespace {

Response respond(const Mat3& F, std::span<const double> p, Asked asked) {
  const auto I1 = first_invariant(F, asked);
  return from_one(I1, p[0] / 2 * (I1.value - 3), p[0] / 2, 0);
}

}  // namespace

Law neo_hookean() {
  return {{"material", "neo_hookean", "incompressible rubber-like solid, linear in the first invariant",
           "Treloar 1943, The elasticity of a network of long-chain molecules II, eq. 7",
           {{"mu", "MPa", {1e-9, 1e6}, 0.0067, "initial shear modulus"}}},
          Kinematics::finite, respond, [](std::span<const double> p) { return p[0]; }, incompressible};
}

}  // namespace palpate::materials
