// Isotropic isochoric laws by principal stretches: from the Kirchhoff stress τ(e), e = dev ln λ, to W, P and A. Every divided
// difference is written so that it stays exact for equal stretches.
// (Simo and Hughes 1998, Computational Inelasticity, §8.2; Ogden 1984, Non-linear Elastic Deformations, §6.1.4.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/materials/law.hpp>

#include <Eigen/Eigenvalues>

namespace palpate::materials {

/// x = λ² in ascending order, their axes in the rest shape (columns), e = dev ln λ.
struct PrincipalStrain {
  Eigen::Vector3d x, e;
  Mat3 axes;
};

/// τ_i = dev ∂W/∂e, its derivative ∂τ_i/∂ln λ_j, and for i < j the slope (τ_j − τ_i)/(ln λ_j − ln λ_i), a limit where λ_i = λ_j.
struct PrincipalStress {
  double W = 0;
  Eigen::Vector3d tau;
  Mat3 derivative, slope;
};

/// ln(1 + t)/t and (exp(t) − 1)/t, exact also at t = 0.
inline double log1p_over(double t) { return t == 0 ? 1 : std::log1p(t) / t; }
inline double expm1_over(double t) { return t == 0 ? 1 : std::expm1(t) / t; }

/// Requires det F > 0.
inline PrincipalStrain principal_strain(const Mat3& F) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(F.transpose() * F);
  const Eigen::Vector3d logarithm = 0.5 * eigen.eigenvalues().array().log().matrix();
  return {eigen.eigenvalues(), logarithm.array() - logarithm.mean(), eigen.eigenvectors()};
}

/// Second Piola-Kirchhoff stress S and tangent 2 ∂S/∂C in principal axes, pushed forward on first and third index:
/// S_i = τ_i/x_i; 2 ∂S_i/∂x_j = (∂τ_i/∂ln λ_j)/(x_i x_j) − 2 δ_ij τ_i/x_i²;
/// (S_j − S_i)/(x_j − x_i) = (½ slope_ij x_i ln(x_j/x_i)/(x_j − x_i) − τ_i)/(x_i x_j).
inline Response from_principal(const Mat3& F, const PrincipalStrain& strain, const PrincipalStress& stress, Asked asked) {
  const Eigen::Vector3d& x = strain.x;
  const Mat3 &N = strain.axes, f = F * N;  // columns: axes, and their images
  const Eigen::Vector3d S = stress.tau.cwiseQuotient(x);
  Response r{stress.W, f * S.asDiagonal() * N.transpose(), {}};
  if (asked == Asked::stress) return r;
  // A = B M Bᵀ + geometric part: dyads of B are stretches 00, 11, 22, then shears 01, 02, 12; M couples the stretches alone.
  Eigen::Matrix<double, 9, 6> B, MB;
  const auto dyad = [&](int a, int b, int j) { return N(j, b) * f.col(a); };  // rows 3 j … 3 j + 2
  for (int j = 0; j < 3; ++j) {
    for (int a = 0; a < 3; ++a) B.block<3, 1>(3 * j, a) = dyad(a, a, j);
    for (int a = 0, k = 3; a < 3; ++a)
      for (int b = a + 1; b < 3; ++b, ++k) B.block<3, 1>(3 * j, k) = dyad(a, b, j) + dyad(b, a, j);
  }
  Mat3 M;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) M(a, b) = stress.derivative(a, b) / (x(a) * x(b)) - 2 * (a == b) * S(a) / x(a);
  MB.leftCols<3>() = B.leftCols<3>().lazyProduct(M);
  for (int a = 0, k = 3; a < 3; ++a)
    for (int b = a + 1; b < 3; ++b, ++k) {
      const double logarithm_over = 0.5 * log1p_over((x(b) - x(a)) / x(a));
      MB.col(k) = (stress.slope(a, b) * logarithm_over - stress.tau(a)) / (x(a) * x(b)) * B.col(k);
    }
  r.A = MB.lazyProduct(B.transpose());
  const Mat3 geometric = N * S.asDiagonal() * N.transpose();
  for (int j = 0; j < 3; ++j)
    for (int l = 0; l < 3; ++l)
      for (int i = 0; i < 3; ++i) r.A(i + 3 * j, i + 3 * l) += geometric(j, l);
  return r;
}

}  // namespace palpate::materials
