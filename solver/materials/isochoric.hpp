// Isochoric invariants Ī1 = J^(−2/3) I1, Ī2 = J^(−4/3) I2 with first and second derivatives by F, and laws W(Ī1, Ī2) of them.
// (Holzapfel 2000, Nonlinear Solid Mechanics, §6.4; the second derivatives are written out here in components.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/materials/law.hpp>

namespace palpate::materials {

/// A scalar of F with gradient and Hessian by F.
struct Invariant {
  double value = 0;
  Mat3 gradient;
  Mat9 hessian;
};

struct IsochoricInvariants {
  Invariant I1, I2;
};

/// Ī1 and Ī2 of F, det F > 0.
inline IsochoricInvariants isochoric_invariants(const Mat3& F) {
  const double J = F.determinant();
  const Mat3 G = F.inverse().transpose();  // ∂ ln J/∂F
  const Mat3 C = F.transpose() * F, b = F * F.transpose();
  const double I1 = C.trace(), I2 = 0.5 * (I1 * I1 - (C * C).trace());
  const double s1 = 2 * std::pow(J, -2.0 / 3), s2 = 2 * std::pow(J, -4.0 / 3);
  const Mat3 H = I1 * F - F * C;  // ½ ∂I2/∂F

  IsochoricInvariants inv;
  inv.I1.value = 0.5 * s1 * I1;
  inv.I2.value = 0.5 * s2 * I2;
  inv.I1.gradient = s1 * (F - I1 / 3 * G);
  inv.I2.gradient = s2 * (H - 2.0 / 3 * I2 * G);
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const double dik = i == k, djl = j == l;
          const double GG = G(i, l) * G(k, j);  // −∂G_ij/∂F_kl
          const double dH = 2 * F(i, j) * F(k, l) + I1 * dik * djl - dik * C(l, j) - F(i, l) * F(k, j) - b(i, k) * djl;
          inv.I1.hessian(i + 3 * j, k + 3 * l) =
              -2.0 / 3 * inv.I1.gradient(i, j) * G(k, l) + s1 * (dik * djl - 2.0 / 3 * G(i, j) * F(k, l) + I1 / 3 * GG);
          inv.I2.hessian(i + 3 * j, k + 3 * l) =
              -4.0 / 3 * inv.I2.gradient(i, j) * G(k, l) + s2 * (dH - 4.0 / 3 * G(i, j) * H(k, l) + 2.0 / 3 * I2 * GG);
        }
  return inv;
}

/// Derivatives of a law W(Ī1, Ī2): W1 = ∂W/∂Ī1, …
struct InvariantEnergy {
  double W = 0, W1 = 0, W2 = 0, W11 = 0;
};

/// P and A by the chain rule. The laws of this folder have no mixed second derivative.
inline Response from_invariants(const IsochoricInvariants& inv, const InvariantEnergy& e) {
  const Vec9 a = Eigen::Map<const Vec9>(inv.I1.gradient.data());
  Response r;
  r.W = e.W;
  r.P = e.W1 * inv.I1.gradient + e.W2 * inv.I2.gradient;
  r.A = e.W1 * inv.I1.hessian + e.W2 * inv.I2.hessian + e.W11 * a * a.transpose();
  return r;
}

}  // namespace palpate::materials
