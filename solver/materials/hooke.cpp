// W = μ |dev ln U|²: Hooke's law made objective by logarithmic (Hencky) strain, by principal stretches.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/hooke_moduli.hpp>
#include <solver/materials/principal.hpp>

namespace palpate::materials {
namespace {

Response respond(const Mat3& F, std::span<const double> p, Asked asked) {
  const double mu = hooke_shear_modulus(p);
  const PrincipalStrain strain = principal_strain(F);
  const Mat3 derivative = 2 * mu * (Mat3::Identity() - Mat3::Constant(1.0 / 3));
  return from_principal(F, strain, {mu * strain.e.squaredNorm(), 2 * mu * strain.e, derivative, Mat3::Constant(2 * mu)}, asked);
}

}  // namespace

Law hooke() {
  return {{"material", "hooke", "Hooke's law made objective: stress linear in logarithmic (Hencky) strain",
           "Hencky 1928, Z. techn. Physik 9:215; the kidney paper's eq. 1-3 in its incremental setting", hooke_parameters()},
          Kinematics::finite, respond, hooke_shear_modulus, hooke_bulk_modulus};
}

}  // namespace palpate::materials
