// Isochoric invariants Ī1 = J^(−2/3) I1, Ī2 = J^(−4/3) I2, Ī4 = J^(−2/3) a·Ca with first and second derivatives by F, and laws of
// them. (Holzapfel 2000, Nonlinear Solid Mechanics, §6.4; the second derivatives are written out here in components.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/materials/law.hpp>

namespace palpate::materials {

/// A scalar of F with gradient and Hessian by F; without, where the stress alone is asked for.
struct Invariant {
  double value = 0;
  Mat3 gradient;
  Mat9 hessian;
  Asked asked = Asked::all;
};

/// J^(−2/3) tr(F M Fᵀ) of F, det F > 0, with a symmetric M of the rest shape: Ī1 for M = I, Ī4 for M = a ⊗ a.
inline Invariant stretch_invariant(const Mat3& F, const Mat3& M, Asked asked) {
  const Mat3 G = F.inverse().transpose();  // ∂ ln J/∂F
  const Mat3 FM = F * M;
  const double I = F.cwiseProduct(FM).sum(), s = 2 * std::pow(F.determinant(), -2.0 / 3);
  Invariant inv{0.5 * s * I, s * (FM - I / 3 * G), {}, asked};
  if (asked == Asked::stress) return inv;
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          inv.hessian(i + 3 * j, k + 3 * l) = -2.0 / 3 * inv.gradient(i, j) * G(k, l) +
                                              s * ((i == k) * M(j, l) - 2.0 / 3 * G(i, j) * FM(k, l) + I / 3 * G(i, l) * G(k, j));
  return inv;
}

/// Ī1 of F, det F > 0.
inline Invariant first_invariant(const Mat3& F, Asked asked) { return stretch_invariant(F, Mat3::Identity(), asked); }

/// Ī4 of F, det F > 0: the square of the isochoric stretch along a unit vector of the rest shape.
inline Invariant fibre_invariant(const Mat3& F, const Eigen::Vector3d& a, Asked asked) { return stretch_invariant(F, a * a.transpose(), asked); }

/// Ī2 of F, det F > 0.
inline Invariant second_invariant(const Mat3& F, Asked asked) {
  const Mat3 G = F.inverse().transpose();
  const Mat3 C = F.transpose() * F, b = F * F.transpose();
  const double I1 = C.trace(), I2 = 0.5 * (I1 * I1 - C.squaredNorm()), s = 2 * std::pow(F.determinant(), -4.0 / 3);
  const Mat3 H = I1 * F - F * C;  // ½ ∂I2/∂F
  Invariant inv{0.5 * s * I2, s * (H - 2.0 / 3 * I2 * G), {}, asked};
  if (asked == Asked::stress) return inv;
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const double dH = 2 * F(i, j) * F(k, l) + (i == k) * ((j == l) * I1 - C(l, j)) - F(i, l) * F(k, j) - (j == l) * b(i, k);
          inv.hessian(i + 3 * j, k + 3 * l) = -4.0 / 3 * inv.gradient(i, j) * G(k, l) +
                                              s * (dH - 4.0 / 3 * G(i, j) * H(k, l) + 2.0 / 3 * I2 * G(i, l) * G(k, j));
        }
  return inv;
}

/// P and A of W(Ī), one invariant, by the chain rule: W1 = ∂W/∂Ī, W11 = ∂²W/∂Ī².
inline Response from_one(const Invariant& I, double W, double W1, double W11) {
  const Vec9 a = Eigen::Map<const Vec9>(I.gradient.data());
  Response r{W, W1 * I.gradient, {}};
  if (I.asked == Asked::stress) return r;
  r.A = W1 * I.hessian;
  if (W11 != 0) r.A += W11 * a * a.transpose();
  return r;
}

}  // namespace palpate::materials
