// W = C10 (Ī1 − 3) + C01 (Ī2 − 3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/isochoric.hpp>

namespace palpate::materials {
namespace {

Response respond(const Mat3& F, std::span<const double> p, Asked asked) {
  const auto I1 = first_invariant(F, asked), I2 = second_invariant(F, asked);
  Response r{p[0] * (I1.value - 3) + p[1] * (I2.value - 3), p[0] * I1.gradient + p[1] * I2.gradient, {}};
  if (asked == Asked::all) r.A = p[0] * I1.hessian + p[1] * I2.hessian;
  return r;
}

}  // namespace

Law mooney_rivlin() {
  return {{"material", "mooney_rivlin", "solid, linear in both invariants; incompressible, or with D1 in its volume energy",
           "Mooney 1940, A theory of large elastic deformation; Rivlin 1948, Phil. Trans. R. Soc. A 241:379",
           {{"C10", "MPa", {1e-9, 1e6}, 0.083, "half the part of the shear modulus carried by I1"},
            {"C01", "MPa", {0, 1e6}, 0.0565, "half the part of the shear modulus carried by I2"}}},
          Kinematics::finite, respond, [](std::span<const double> p) { return 2 * (p[0] + p[1]); }, incompressible, 1};
}

}  // namespace palpate::materials
