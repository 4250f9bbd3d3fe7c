// A law's response near a deformation where it is known, to first order: for the runs beside a run that sensitivities need, which differ from it by
// 10⁻⁷, so that what is left out is 10⁻¹⁴.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/materials/law.hpp>

namespace palpate::materials {

struct KnownLaw {
  Mat3 F, P;
  double W = 0;
  Eigen::Matrix<float, 9, 9> A;  ///< single precision: it is multiplied by differences alone

  void learn(const Mat3& at, const Response& r, Asked asked) {
    F = at;
    P = r.P;
    W = r.W;
    if (asked == Asked::all) A = r.A.cast<float>();
  }
  /// Energy and stress at a deformation close by; no tangent.
  Response at(const Mat3& near) const {
    Response r{W, P, {}};
    if (near == F) return r;
    const Mat3 step = near - F;
    r.W += P.cwiseProduct(step).sum();
    Eigen::Map<Vec9>(r.P.data()) += (A * Eigen::Map<const Vec9>(step.data()).cast<float>()).cast<double>();
    return r;
  }
};

/// What a law with another number says more than a known one.
struct LawShift {
  Mat3 P = Mat3::Zero();
  double W = 0;
};

inline LawShift shift(const KnownLaw& other, const KnownLaw& known) {
  const Response r = known.at(other.F);
  return {other.P - r.P, other.W - r.W};
}

inline KnownLaw shifted(KnownLaw known, const LawShift& by) {
  known.P += by.P;
  known.W += by.W;
  return known;
}

}  // namespace palpate::materials
