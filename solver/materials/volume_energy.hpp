// Volume energy U(J) = κ/2 (J − 1)² + s2 (J − 1)⁴ + s3 (J − 1)⁶, si = 1/Di, and the dilation J − 1 = U*′(p) at which U′ is p.
// With κ = 2/D1 this is Σ (J − 1)^(2i)/Di. The element needs only U*′ and U*″: p (J − 1) − U*(p) is its potential.
// (Pressure as an unknown beside a general volume energy: Sussman and Bathe 1987, Computers & Structures 26:357.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <limits>

namespace palpate::materials {

struct VolumeEnergy {
  double bulk_modulus = std::numeric_limits<double>::infinity();  ///< κ in MPa; infinite: no dilation at all
  double s2 = 0, s3 = 0;                                          ///< MPa, not negative
};

/// J − 1 and its derivative by p, 1/MPa.
struct Dilation {
  double value = 0, slope = 0;
};

/// U′ is odd and convex on one side, so Newton from p/κ comes down to the root without passing it.
inline Dilation dilation(const VolumeEnergy& U, double p) {
  if (!std::isfinite(U.bulk_modulus)) return {};
  double t = p / U.bulk_modulus;
  for (;;) {
    const double t2 = t * t, slope = 1 / (U.bulk_modulus + t2 * (12 * U.s2 + t2 * 30 * U.s3));
    if (U.s2 == 0 && U.s3 == 0) return {t, slope};
    const double next = t - slope * (t * (U.bulk_modulus + t2 * (4 * U.s2 + t2 * 6 * U.s3)) - p);
    if (!(std::abs(next) < std::abs(t))) return {t, slope};
    t = next;
  }
}

/// U*(p) = p (J − 1) − U, where `t` = J − 1 = U*′(p), MPa.
inline double dual(const VolumeEnergy& U, double p, double t) {
  if (!std::isfinite(U.bulk_modulus)) return 0;
  const double t2 = t * t;
  return p * t - t2 * (U.bulk_modulus / 2 + t2 * (U.s2 + t2 * U.s3));
}

}  // namespace palpate::materials
