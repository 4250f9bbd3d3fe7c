// What a contact point's pressure leaves open: g(t) = −w t/(A + t), linearised at the pressure that is carried (decision 021).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>

namespace palpate::contact {

/// No point of a solution lies deeper inside a tool or another organ than this part of the local element size.
constexpr double deepest_gap = 0.01;

struct GapLaw {
  double gap = 0;        ///< of the pressure carried, mm, not positive
  double stiffness = 0;  ///< −dt/dg there, MPa/mm

  /// `softness` (MPa): A, the pressure that leaves half of the deepest gap; `deepest` (mm): w; `carried` (MPa): not negative.
  GapLaw(double carried, double softness, double deepest)
      : gap(-deepest * carried / (softness + carried)), stiffness((softness + carried) * (softness + carried) / (softness * deepest)) {}

  /// The pressure that a gap asks for, to first order; not positive: the point is let go.
  double pressure(double carried, double measured) const { return carried + stiffness * (gap - measured); }

  /// ∫ t d(−g) up to the pressure t: what the gap stores per area, N/mm.
  static double energy(double t, double softness, double deepest) { return deepest * softness * (std::log1p(t / softness) - t / (softness + t)); }
};

}  // namespace palpate::contact
