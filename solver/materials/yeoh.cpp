// W = C10 (Ī1 − 3) + C20 (Ī1 − 3)² + C30 (Ī1 − 3)³.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/isochoric.hpp>

namespace palpate::materials {
namespace {

Response respond(const Mat3& F, std::span<const double> p, Asked asked) {
  const auto I1 = first_invariant(F, asked);
  const double t = I1.value - 3;
  return from_one(I1, t * (p[0] + t * (p[1] + t * p[2])), p[0] + t * (2 * p[1] + t * 3 * p[2]), 2 * p[1] + 6 * t * p[2]);
}

}  // namespace

Law yeoh() {
  return {{"material", "yeoh", "solid, cubic in the first invariant; incompressible, or with D1 (D2, D3) in its volume energy",
           "Yeoh 1993, Some forms of the strain energy function for rubber, Rubber Chem. Technol. 66:754",
           {{"C10", "MPa", {1e-9, 1e6}, 0.0034, "half the initial shear modulus"},
            {"C20", "MPa", {-1e6, 1e6}, 0.0012, "coefficient of (I1 - 3)²"},
            {"C30", "MPa", {-1e6, 1e6}, 0.0005, "coefficient of (I1 - 3)³; 0 leaves it out"}}},
          Kinematics::finite, respond, [](std::span<const double> p) { return 2 * p[0]; }, incompressible, 3};
}

}  // namespace palpate::materials
