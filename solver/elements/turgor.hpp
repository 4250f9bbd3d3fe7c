// Tissue under an isotropic tension p that a pressure p of what fills it balances: W = p [½ (F : F − 3) − (J − 1)], P = p (F − cof F).
// At rest nothing pulls; deformed, the tension resists as a string does. (Initial stress in the second Piola-Kirchhoff sense:
// Holzapfel 2000, Nonlinear Solid Mechanics, §3.4; the pressure is a dead one of the fluid.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/elements/cofactor.hpp>

namespace palpate::elements {

/// `turgor`: p in MPa. With the geometry not updated, to first order: P = p (H + Hᵀ − I tr H), H = F − I.
inline void add_turgor(materials::Response& r, const materials::Mat3& F, double turgor, materials::Kinematics kinematics, materials::Asked asked) {
  using materials::Mat3;
  const bool small = kinematics == materials::Kinematics::small;
  const Mat3 at = small ? Mat3(Mat3::Identity()) : F, H = F - Mat3::Identity();
  if (asked == materials::Asked::all) {
    r.A.diagonal().array() += turgor;
    add_cofactor_derivative(r.A, -turgor * at);
  }
  const Mat3 P = small ? Mat3(H + H.transpose() - H.trace() * Mat3::Identity()) : Mat3(F - cofactor(F));
  r.P += turgor * P;
  r.W += turgor * (small ? 0.5 * P.cwiseProduct(H).sum() : 0.5 * (F.squaredNorm() - 3) - (F.determinant() - 1));
}

}  // namespace palpate::elements
