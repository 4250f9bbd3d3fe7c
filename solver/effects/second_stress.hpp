// Second Piola-Kirchhoff stress S = F⁻¹ P as six numbers (xx, yy, zz, xy, yz, xz), and what it adds to P and ∂P/∂F. With the geometry
// not updated F is I. (Holzapfel 2000, Nonlinear Solid Mechanics, eq. 3.63.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/effects/effect.hpp>

namespace palpate::effects {

inline Mat3 tensor(const double* v) {
  Mat3 T;
  T << v[0], v[3], v[5], v[3], v[1], v[4], v[5], v[4], v[2];
  return T;
}
inline Vec6 six(const Mat3& T) {
  Vec6 v;
  v << T(0, 0), T(1, 1), T(2, 2), 0.5 * (T(0, 1) + T(1, 0)), 0.5 * (T(1, 2) + T(2, 1)), 0.5 * (T(0, 2) + T(2, 0));
  return v;
}

inline Mat3 second_stress(const Point& point, const Mat3& P) {
  return point.kinematics == materials::Kinematics::small ? P : Mat3(point.F.inverse() * P);
}

/// Adds a second Piola-Kirchhoff stress that does not depend on F: P += F S, A_ijkl += δ_ik S_lj.
inline void add_second_stress(Response& r, const Point& point, const Mat3& S) {
  if (point.kinematics == materials::Kinematics::small) {
    r.P += S;
    return;
  }
  r.P += point.F * S;
  if (!point.wants_tangent()) return;  // no tangent is asked for
  for (int j = 0; j < 3; ++j)
    for (int l = 0; l < 3; ++l)
      for (int i = 0; i < 3; ++i) r.A(i + 3 * j, i + 3 * l) += S(l, j);
}

}  // namespace palpate::effects
