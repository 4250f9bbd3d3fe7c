// cof F = ∂ det F/∂F and its derivative, ∂(cof F)_ij/∂F_kl = ε_ikm ε_jln F_mn.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/materials/law.hpp>

namespace palpate::elements {

inline materials::Mat3 cofactor(const materials::Mat3& F) {
  materials::Mat3 c;
  c.col(0) = F.col(1).cross(F.col(2));
  c.col(1) = F.col(2).cross(F.col(0));
  c.col(2) = F.col(0).cross(F.col(1));
  return c;
}

/// A += ∂cof F/∂F, linear in F.
inline void add_cofactor_derivative(materials::Mat9& A, const materials::Mat3& F) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int k = (i + 1) % 3, m = (i + 2) % 3, l = (j + 1) % 3, n = (j + 2) % 3;
      A(i + 3 * j, k + 3 * l) += F(m, n);
      A(i + 3 * j, m + 3 * n) += F(k, l);
      A(i + 3 * j, k + 3 * n) -= F(m, l);
      A(i + 3 * j, m + 3 * l) -= F(k, n);
    }
}

}  // namespace palpate::elements
