// σ = 2 μ dev ε + p I, ε = sym(F − I), geometry not updated: W = μ dev ε : dev ε.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/hooke_moduli.hpp>

namespace palpate::materials {
namespace {

Response respond(const Mat3& F, std::span<const double> p, Asked asked) {
  const double mu = hooke_shear_modulus(p);
  const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
  const Mat3 deviator = strain - strain.trace() / 3 * Mat3::Identity();
  Response r;
  r.W = mu * deviator.squaredNorm();
  r.P = 2 * mu * deviator;
  if (asked == Asked::stress) return r;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      r.A(i + 3 * j, i + 3 * j) += mu;
      r.A(i + 3 * j, j + 3 * i) += mu;
      r.A(i + 3 * i, j + 3 * j) -= 2 * mu / 3;
    }
  return r;
}

}  // namespace

Law hooke_linear() {
  return {{"material", "hooke_linear", "Hooke's law at small strain, geometry not updated: for patch tests and Hertz",
           "Zienkiewicz and Taylor 2000, The Finite Element Method vol. 1, §12.2", hooke_parameters()},
          Kinematics::small, respond, hooke_shear_modulus, hooke_bulk_modulus};
}

}  // namespace palpate::materials
