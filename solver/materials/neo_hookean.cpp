// W = μ/2 (Ī1 − 3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/isochoric.hpp>

namespace palpate::materials {
namespace {

Response respond(const Mat3& F, std::span<const double> p) {
  const auto inv = isochoric_invariants(F);
  return from_invariants(inv, {.W = p[0] / 2 * (inv.I1.value - 3), .W1 = p[0] / 2});
}

}  // namespace

Law neo_hookean() {
  return {{"material", "neo_hookean", "incompressible rubber-like solid, linear in the first invariant",
           "Treloar 1943, The elasticity of a network of long-chain molecules II, eq. 7",
           {{"mu", "MPa", {1e-9, 1e6}, 0.0067, "initial shear modulus"}}},
          Kinematics::finite, respond, [](std::span<const double> p) { return p[0]; }, incompressible};
}

}  // namespace palpate::materials
