// W = μ |dev ln U|²: Hooke's law made objective by logarithmic (Hencky) strain, by principal stretches.
// (Hencky 1928; tangent: Simo and Hughes 1998, Computational Inelasticity, §8.2; the divided difference is written so that
// it stays exact for equal stretches.)
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/materials/hooke_moduli.hpp>

#include <Eigen/Eigenvalues>

namespace palpate::materials {
namespace {

/// ln(1 + t)/t, exact at t = 0.
double log1p_over(double t) { return std::abs(t) < 1e-9 ? 1 - t / 2 : std::log1p(t) / t; }

/// Second Piola-Kirchhoff stress and its tangent 2 ∂S/∂C in principal axes, x = λ² and e = dev ln λ:
/// S_i = 2 μ e_i/x_i; 2 ∂S_i/∂x_j = 2 μ ((δ_ij − 1/3)/(x_i x_j) − 2 δ_ij e_i/x_i²);
/// (S_j − S_i)/(x_j − x_i) = 2 μ (½ x_j ln(x_j/x_i)/(x_j − x_i) − e_j)/(x_i x_j).
struct Principal {
  Eigen::Vector3d S;
  Mat3 direct, shear;
};

Principal principal(double mu, const Eigen::Vector3d& x, const Eigen::Vector3d& e) {
  Principal r;
  for (int i = 0; i < 3; ++i) {
    r.S(i) = 2 * mu * e(i) / x(i);
    for (int j = 0; j < 3; ++j) {
      r.direct(i, j) = 2 * mu * (((i == j) - 1.0 / 3) / (x(i) * x(j)) - 2 * (i == j) * e(i) / (x(i) * x(i)));
      r.shear(i, j) = 2 * mu * (0.5 * x(j) / x(i) * log1p_over((x(j) - x(i)) / x(i)) - e(j)) / (x(i) * x(j));
    }
  }
  return r;
}

Response respond(const Mat3& F, std::span<const double> p) {
  const double mu = hooke_shear_modulus(p);
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(F.transpose() * F);
  const Eigen::Vector3d x = eigen.eigenvalues();
  const Eigen::Vector3d logarithm = 0.5 * x.array().log().matrix();
  const Eigen::Vector3d e = logarithm.array() - logarithm.mean();
  const Principal s = principal(mu, x, e);
  const Mat3 N = eigen.eigenvectors(), f = F * N;  // columns: axes, and their images

  Response r;
  r.W = mu * e.squaredNorm();
  r.P = f * s.S.asDiagonal() * N.transpose();
  // A = δ_ik S_jl + Σ_ab c_ab-terms of (f_a ⊗ N_b): the material tangent pushed forward on its first and third index.
  const Mat3 S = N * s.S.asDiagonal() * N.transpose();
  Vec9 fN[3][3];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const Mat3 dyad = f.col(a) * N.col(b).transpose();
      fN[a][b] = Eigen::Map<const Vec9>(dyad.data());
    }
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      r.A += s.direct(a, b) * fN[a][a] * fN[b][b].transpose();
      if (a != b) r.A += s.shear(a, b) * fN[a][b] * (fN[a][b] + fN[b][a]).transpose();
    }
  for (int j = 0; j < 3; ++j)
    for (int l = 0; l < 3; ++l)
      for (int i = 0; i < 3; ++i) r.A(i + 3 * j, i + 3 * l) += S(j, l);
  return r;
}

}  // namespace

Law hooke() {
  return {{"material", "hooke", "Hooke's law made objective: stress linear in logarithmic (Hencky) strain",
           "Hencky 1928, Z. techn. Physik 9:215; the kidney paper's eq. 1-3 in its incremental setting", hooke_parameters()},
          Kinematics::finite, respond, hooke_shear_modulus, hooke_bulk_modulus};
}

}  // namespace palpate::materials
