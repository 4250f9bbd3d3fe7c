// W = Σ 2 μi/αi² (λ̄1^αi + λ̄2^αi + λ̄3^αi − 3), i = 1..3, of isochoric principal stretches λ̄ = exp(e).
// As Σ e = 0 this is Σ 2 μi Σ_k e_k² φ(αi e_k), φ(t) = (exp(t) − 1 − t)/t²: it goes over into logarithmic strain as αi → 0.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/principal.hpp>

namespace palpate::materials {
namespace {

/// (exp(t) − 1 − t)/t², by its series near 0 (remainder below 1e-16).
double phi(double t) {
  if (std::abs(t) > 0.01) return (std::expm1(t) - t) / (t * t);
  return 1.0 / 2 + t * (1.0 / 6 + t * (1.0 / 24 + t * (1.0 / 120 + t * (1.0 / 720 + t / 5040))));
}

Response respond(const Mat3& F, std::span<const double> p, Asked asked) {
  const PrincipalStrain strain = principal_strain(F);
  const Eigen::Vector3d& e = strain.e;
  PrincipalStress stress{0, Eigen::Vector3d::Zero(), Mat3::Zero(), Mat3::Zero()};
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  // ∂²W/∂e_k²
  for (int term = 0; term < 3; ++term) {
    const double twice = 2 * p[2 * term], alpha = p[2 * term + 1];
    if (twice == 0) continue;
    for (int k = 0; k < 3; ++k) {
      stress.W += twice * e(k) * e(k) * phi(alpha * e(k));
      stress.tau(k) += twice * e(k) * expm1_over(alpha * e(k));
      if (asked == Asked::stress) continue;
      rate(k) += twice * std::exp(alpha * e(k));
      for (int j = k + 1; j < 3; ++j)  // (exp(α e_j) − exp(α e_k))/(α (e_j − e_k))
        stress.slope(k, j) += twice * std::exp(alpha * e(k)) * expm1_over(alpha * (e(j) - e(k)));
    }
  }
  stress.tau.array() -= stress.tau.mean();
  const Mat3 deviator = Mat3::Identity() - Mat3::Constant(1.0 / 3);
  stress.derivative = deviator * rate.asDiagonal() * deviator;
  return from_principal(F, strain, stress, asked);
}

}  // namespace

Law ogden() {
  return {{"material", "ogden", "incompressible solid, up to three powers of the principal stretches",
           "Ogden 1972, Large deformation isotropic elasticity, Proc. R. Soc. Lond. A 326:565",
           {{"mu1", "MPa", {1e-9, 1e6}, 0.004, "part of the initial shear modulus carried by the first term"},
            {"alpha1", "1", {-50, 50}, 3, "power of the first term; 0: logarithmic strain"},
            {"mu2", "MPa", {0, 1e6}, 0.002, "the same of the second term; 0 leaves it out"},
            {"alpha2", "1", {-50, 50}, -4, "power of the second term"},
            {"mu3", "MPa", {0, 1e6}, 0.0007, "the same of the third term; 0 leaves it out"},
            {"alpha3", "1", {-50, 50}, 8, "power of the third term"}}},
          Kinematics::finite, respond, [](std::span<const double> p) { return p[0] + p[2] + p[4]; }, incompressible};
}

}  // namespace palpate::materials
