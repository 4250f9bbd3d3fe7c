// Three-node shell triangle: constant membrane strain, constant curvature from directors at the middles of the edges (Morley 1971),
// finite rotations, hyperelastic through five points of the thickness. Decision 050.
//   a = FᵀF,  h = Σ_k 4 tan(φ_k/4) (L_k/l_k) P_k,  P_k = (L_k/A) M_k ⊗ M_k,  K = 2 h − (b0 a + a b0),
//   C(ζ) = a + ζ K + (⁴√(p⁴ + σ⁴) − p) K a⁻¹ K / tr(K a⁻¹)²,  σ² = ζ² tr(K a⁻¹)²
// φ_k: angle from the triangle's normal to the director of edge k; L, l, M: the edge's length at rest and now, its outward normal at
// rest. h is the curvature times the stretch of the thickness, so C is linear in ζ as it is in Rivlin's bent block; the last term, of
// fourth order, keeps C above 1 − p where a triangle is folded more sharply than its thickness allows: 1 − σ + (⁴√(p⁴ + σ⁴) − p) falls to it,
// and the moment grows with every turn.
// (Morley, J. Strain Analysis 6:20; Providas & Kattis 1999, Comput. Mech. 24:208; Rivlin 1949, Proc. R. Soc. A 195:463.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include <solver/materials/plane_stress.hpp>

namespace palpate::elements {

using materials::InPlane;

/// Gauss-Legendre on [−1, 1].
constexpr int layers = 5;
constexpr std::array<double, layers> layer_place{-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
constexpr std::array<double, layers> layer_weight{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};

constexpr double most_shortening = 0.9;  ///< p: of the square of a length across a fold, at its inner side

/// At rest, in the triangle's own plane. Edge k lies opposite corner k. T: double or Lanes.
template <class T>
struct ShellRest {
  T g1x, g1y, g2x, g2y;          ///< gradients of the shape functions of corners 1 and 2, 1/mm
  T area, thickness;             ///< mm², mm
  std::array<T, 3> length;       ///< of the edges, mm
  std::array<InPlane<T>, 3> P;   ///< 1/mm
  InPlane<T> b0;                 ///< curvature at rest, 1/mm
  std::array<T, 3> sign;         ///< +1 where the edge runs with the triangle, else −1
};

template <class T>
struct ShellNow {
  std::array<Vector<T>, 3> x;         ///< corners, mm
  std::array<Vector<T>, 3> director;  ///< of the edges, unit, at right angles to them
};

/// Derivatives of the energy: forces that resist, N and N mm.
template <class T>
struct ShellForces {
  std::array<Vector<T>, 3> force;
  std::array<T, 3> moment;  ///< by the director's turn about its edge
  T energy;                 ///< N mm
};

/// What the corners and directors say, before any material is asked.
template <class T>
struct ShellStrain {
  Vector<T> F1, F2, n;
  std::array<Vector<T>, 3> edge;
  T twice_area;
  std::array<T, 3> length, f, f_slope;  ///< f = 4 tan(φ/4)
  InPlane<T> a, K;
  InPlane<T> inverse, Q;                ///< a⁻¹, K a⁻¹ K
  T Bxx, Bxy, Byx, Byy;                 ///< a⁻¹ K
  T k2;                                 ///< tr(K a⁻¹)²
};

template <class T>
PALPATE_INLINE ShellStrain<T> shell_strain(const ShellRest<T>& rest, const ShellNow<T>& now) {
  ShellStrain<T> s;
  const Vector<T> u = now.x[1] - now.x[0], v = now.x[2] - now.x[0], normal = cross(u, v);
  s.edge = {v - u, now.x[0] - now.x[2], u};
  s.twice_area = root(dot(normal, normal));
  s.n = (1.0 / s.twice_area) * normal;
  s.F1 = rest.g1x * u + rest.g2x * v;
  s.F2 = rest.g1y * u + rest.g2y * v;
  s.a = {dot(s.F1, s.F1), dot(s.F2, s.F2), dot(s.F1, s.F2)};
  InPlane<T> h{T{}, T{}, T{}};
  for (int k = 0; k < 3; ++k) {
    const T length = root(dot(s.edge[k], s.edge[k])), over = 1.0 / length;
    const T sine = dot(now.director[k], cross(s.edge[k], s.n)) * over, cosine = dot(now.director[k], s.n);
    s.length[k] = length;
    const T half = sine / (1.0 + cosine), quarter = half / (1.0 + root(1.0 + half * half));  // tan(φ/2), tan(φ/4)
    s.f[k] = 4.0 * quarter;
    s.f_slope[k] = 1.0 + quarter * quarter;
    const T weight = s.f[k] * rest.length[k] * over;
    h = {h.xx + weight * rest.P[k].xx, h.yy + weight * rest.P[k].yy, h.xy + weight * rest.P[k].xy};
  }
  const InPlane<T>&a = s.a, &b = rest.b0;
  s.K = {2.0 * (h.xx - b.xx * a.xx - b.xy * a.xy), 2.0 * (h.yy - b.xy * a.xy - b.yy * a.yy),
         2.0 * h.xy - b.xx * a.xy - b.xy * (a.xx + a.yy) - a.xy * b.yy};
  const T over = 1.0 / (a.xx * a.yy - a.xy * a.xy);
  s.inverse = {over * a.yy, over * a.xx, -over * a.xy};
  s.Bxx = s.inverse.xx * s.K.xx + s.inverse.xy * s.K.xy, s.Bxy = s.inverse.xx * s.K.xy + s.inverse.xy * s.K.yy;
  s.Byx = s.inverse.xy * s.K.xx + s.inverse.yy * s.K.xy, s.Byy = s.inverse.xy * s.K.xy + s.inverse.yy * s.K.yy;
  s.Q = {s.K.xx * s.Bxx + s.K.xy * s.Byx, s.K.xy * s.Bxy + s.K.yy * s.Byy, s.K.xx * s.Bxy + s.K.xy * s.Byy};
  s.k2 = s.Bxx * s.Bxx + 2.0 * (s.Bxy * s.Byx) + s.Byy * s.Byy;
  return s;
}

/// The last term is q K a⁻¹ K: q by ζ² and tr(K a⁻¹)², and its slope by the latter.
template <class T>
struct Fold {
  T q, slope;
};

template <class T>
PALPATE_INLINE Fold<T> fold(const T& square, const T& k2) {
  constexpr double p = most_shortening;
  const T sigma2 = square * k2, r2 = root(T{} + p * p * p * p + sigma2 * sigma2), r = root(r2), over = 1.0 / ((r + p) * (r2 + p * p));  // (r − p)/σ⁴
  return {square * sigma2 * over, square * square * (0.5 / (r * r2) - over)};
}

template <class T>
PALPATE_INLINE InPlane<T> at_layer(const ShellStrain<T>& s, const T& zeta) {
  const T q = fold(zeta * zeta, s.k2).q;
  return {s.a.xx + zeta * s.K.xx + q * s.Q.xx, s.a.yy + zeta * s.K.yy + q * s.Q.yy, s.a.xy + zeta * s.K.xy + q * s.Q.xy};
}

/// Conjugate to ½ δa and ½ δK: N = Σ w S and M = Σ w ζ S over the thickness, with what C's last term adds; and the energy per area.
template <class T>
struct ShellStress {
  InPlane<T> N{T{}, T{}, T{}}, M{T{}, T{}, T{}};
  T W{};
};

/// H : δQ + r δk2 = (2 B H + 2 r a⁻¹ K a⁻¹) : δK − (B H Bᵀ + 2 r a⁻¹ Q a⁻¹) : δa, with B = a⁻¹ K.
template <class T>
PALPATE_INLINE void add_last_term(const ShellStrain<T>& s, const InPlane<T>& H, const T& r, ShellStress<T>& sum) {
  const T BHxx = s.Bxx * H.xx + s.Bxy * H.xy, BHxy = s.Bxx * H.xy + s.Bxy * H.yy;
  const T BHyx = s.Byx * H.xx + s.Byy * H.xy, BHyy = s.Byx * H.xy + s.Byy * H.yy;
  const InPlane<T>& v = s.inverse;
  const T two = 2.0 * r;  // a⁻¹ K a⁻¹ = B a⁻¹ and a⁻¹ Q a⁻¹ = B B a⁻¹
  const T Vxx = s.Bxx * v.xx + s.Bxy * v.xy, Vxy = s.Bxx * v.xy + s.Bxy * v.yy, Vyy = s.Byx * v.xy + s.Byy * v.yy;
  sum.M = {sum.M.xx + 2.0 * BHxx + two * Vxx, sum.M.yy + 2.0 * BHyy + two * Vyy, sum.M.xy + BHxy + BHyx + two * Vxy};
  sum.N = {sum.N.xx - (BHxx * s.Bxx + BHxy * s.Bxy) - two * (s.Bxx * Vxx + s.Bxy * Vxy),
           sum.N.yy - (BHyx * s.Byx + BHyy * s.Byy) - two * (s.Byx * Vxy + s.Byy * Vyy),
           sum.N.xy - (BHxx * s.Byx + BHxy * s.Byy) - two * (s.Bxx * Vxy + s.Bxy * Vyy)};
}

/// A sum over points of the thickness, before the last term is added.
template <class T>
struct LayerSum {
  ShellStress<T> stress;
  InPlane<T> H{T{}, T{}, T{}};  ///< by Q
  T r{};                        ///< by k2
};

/// A point at ζ with the weight w (mm): its S, conjugate to ½ δC.
template <class T>
PALPATE_INLINE void add_layer(const ShellStrain<T>& s, const T& zeta, const T& w, const InPlane<T>& stress, LayerSum<T>& sums) {
  ShellStress<T>& sum = sums.stress;
  const InPlane<T> S{w * stress.xx, w * stress.yy, w * stress.xy};
  sum.N = {sum.N.xx + S.xx, sum.N.yy + S.yy, sum.N.xy + S.xy};
  sum.M = {sum.M.xx + zeta * S.xx, sum.M.yy + zeta * S.yy, sum.M.xy + zeta * S.xy};
  const auto [q, slope] = fold(zeta * zeta, s.k2);
  sums.H = {sums.H.xx + q * S.xx, sums.H.yy + q * S.yy, sums.H.xy + q * S.xy};
  sums.r += slope * (S.xx * s.Q.xx + S.yy * s.Q.yy + 2.0 * (S.xy * s.Q.xy));
}

template <class T, class Law>
PALPATE_INLINE ShellStress<T> shell_stress(const ShellRest<T>& rest, const ShellStrain<T>& s, const Law& law) {
  LayerSum<T> sums;
  for (int i = 0; i < layers; ++i) {
    const T zeta = 0.5 * layer_place[i] * rest.thickness, w = 0.5 * layer_weight[i] * rest.thickness;
    const auto p = law(at_layer(s, zeta));
    add_layer(s, zeta, w, p.S, sums);
    sums.stress.W += w * p.W;
  }
  add_last_term(s, sums.H, sums.r, sums.stress);
  return sums.stress;
}

/// The principle of virtual work: ½ N : δa + ½ M : δK.
template <class T>
PALPATE_INLINE ShellForces<T> shell_forces(const ShellRest<T>& rest, const ShellNow<T>& now, const ShellStrain<T>& s, const ShellStress<T>& t) {
  ShellForces<T> out;
  out.energy = rest.area * t.W;
  const InPlane<T>&M = t.M, &b = rest.b0;
  const T Nxx = t.N.xx - 2.0 * (M.xx * b.xx + M.xy * b.xy), Nyy = t.N.yy - 2.0 * (M.xy * b.xy + M.yy * b.yy);
  const T Nxy = t.N.xy - (M.xx * b.xy + M.xy * b.yy + b.xx * M.xy + b.xy * M.yy);
  const Vector<T> p1 = rest.area * (Nxx * s.F1 + Nxy * s.F2), p2 = rest.area * (Nxy * s.F1 + Nyy * s.F2);
  out.force[1] = rest.g1x * p1 + rest.g1y * p2;
  out.force[2] = rest.g2x * p1 + rest.g2y * p2;
  out.force[0] = T{} * p1 - out.force[1] - out.force[2];
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, c = (k + 2) % 3;
    const T over = 1.0 / s.length[k];
    const InPlane<T>& P = rest.P[k];
    const T by_f = rest.area * rest.length[k] * over * (M.xx * P.xx + M.yy * P.yy + 2.0 * (M.xy * P.xy));
    const T by_angle = by_f * s.f_slope[k];
    out.moment[k] = rest.sign[k] * by_angle;
    const Vector<T> lift = (by_angle * s.length[k] / s.twice_area) * s.n;  // corner k turns the triangle about the edge
    const T foot = dot(now.x[k] - now.x[a], s.edge[k]) * over * over;
    const Vector<T> pull = (-by_f * s.f[k] * over * over) * s.edge[k];     // the edge's own length
    out.force[k] = out.force[k] - lift;
    out.force[a] = out.force[a] + (1.0 - foot) * lift - pull;
    out.force[c] = out.force[c] + foot * lift + pull;
  }
  return out;
}

}  // namespace palpate::elements
