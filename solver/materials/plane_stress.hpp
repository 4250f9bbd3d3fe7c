// Isotropic laws in plane stress: second Piola-Kirchhoff stress S = 2 ∂W/∂C of the in-plane C, the thickness following from σ33 = 0.
// Incompressible: C33 = 1/det C, so with i = 1/det C and adj C = det C · C⁻¹
//   I1 = tr C + i,  I2 = det C + i tr C,   S = 2 [(W1 + i W2) I + (W2 − i² (W1 + W2 tr C)) adj C].
// (Holzapfel 2000, Nonlinear Solid Mechanics, §6.3, with p eliminated.) By value and without virtual calls: T is a double or Lanes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/elements/lanes.hpp>

namespace palpate::materials {

using elements::each;
using elements::Lanes;

/// Symmetric 2 × 2.
template <class T>
struct InPlane {
  T xx, yy, xy;
};

/// S in MPa, W in MPa, thickness stretch λ3.
template <class T>
struct PlaneStress {
  InPlane<T> S;
  T W, thickness;
};

/// S from W1 = ∂W/∂I1, W2 = ∂W/∂I2.
template <class T>
PALPATE_INLINE InPlane<T> incompressible_stress(const InPlane<T>& C, const T& i, const T& W1, const T& W2) {
  const T diagonal = 2.0 * (W1 + i * W2), adjoint = 2.0 * (W2 - i * i * (W1 + W2 * (C.xx + C.yy)));
  return {diagonal + adjoint * C.yy, diagonal + adjoint * C.xx, -adjoint * C.xy};
}

template <class T>
PALPATE_INLINE T inverse_determinant(const InPlane<T>& C) {
  return 1.0 / (C.xx * C.yy - C.xy * C.xy);
}

struct NeoHookeanShell {
  double mu;
  double shear_modulus() const { return mu; }
  double poisson() const { return 0.5; }
  template <class T>
  PALPATE_INLINE PlaneStress<T> operator()(const InPlane<T>& C) const {
    const T i = inverse_determinant(C);
    return {incompressible_stress(C, i, T{} + 0.5 * mu, T{}), 0.5 * mu * (C.xx + C.yy + i - 3.0), elements::root(i)};
  }
};

struct MooneyRivlinShell {
  double C10, C01;
  double shear_modulus() const { return 2 * (C10 + C01); }
  double poisson() const { return 0.5; }
  template <class T>
  PALPATE_INLINE PlaneStress<T> operator()(const InPlane<T>& C) const {
    const T i = inverse_determinant(C), trace = C.xx + C.yy;
    return {incompressible_stress(C, i, T{} + C10, T{} + C01), C10 * (trace + i - 3.0) + C01 * (1.0 / i + i * trace - 3.0), elements::root(i)};
  }
};

struct YeohShell {
  double C10, C20, C30;
  double shear_modulus() const { return 2 * C10; }
  double poisson() const { return 0.5; }
  template <class T>
  PALPATE_INLINE PlaneStress<T> operator()(const InPlane<T>& C) const {
    const T i = inverse_determinant(C), t = C.xx + C.yy + i - 3.0;
    return {incompressible_stress(C, i, C10 + t * (2 * C20 + t * (3 * C30)), T{}), t * (C10 + t * (C20 + t * C30)), elements::root(i)};
  }
};

struct FungDemirayShell {
  double mu, b;
  double shear_modulus() const { return mu; }
  double poisson() const { return 0.5; }
  template <class T>
  PALPATE_INLINE PlaneStress<T> operator()(const InPlane<T>& C) const {
    const T i = inverse_determinant(C);
    const T e = each(b * (C.xx + C.yy + i - 3.0), [](double Q) { return std::expm1(Q); });
    return {incompressible_stress(C, i, 0.5 * mu * (e + 1.0), T{}), mu / (2 * b) * e, elements::root(i)};
  }
};

/// S from the principal Kirchhoff stresses of a law of ln λ1, ln λ2: eigenvalues x of C by m ± r, S = Σ τ_i/x_i N_i ⊗ N_i.
template <class T, class Principal>
PALPATE_INLINE PlaneStress<T> by_principal(const InPlane<T>& C, const Principal& law) {
  const T m = 0.5 * (C.xx + C.yy), d = 0.5 * (C.xx - C.yy);
  const T r = elements::at_least(elements::root(d * d + C.xy * C.xy), 1e-9 * m);  // equal stretches: any axes do
  const T x1 = m + r, x2 = m - r;
  const auto log = [](double x) { return 0.5 * std::log(x); };
  const auto principal = law(each(x1, log), each(x2, log));
  const T s1 = principal.tau1 / x1, s2 = principal.tau2 / x2, mean = 0.5 * (s1 + s2), part = 0.5 * (s1 - s2) / r;
  return {{mean + part * d, mean - part * d, part * C.xy}, principal.W, principal.thickness};
}

template <class T>
struct Principal {
  T tau1, tau2, W, thickness;
};

struct OgdenShell {
  double mu[3], alpha[3];
  double shear_modulus() const { return mu[0] + mu[1] + mu[2]; }
  double poisson() const { return 0.5; }
  template <class T>
  PALPATE_INLINE PlaneStress<T> operator()(const InPlane<T>& C) const {
    return by_principal(C, [this](const T& e1, const T& e2) {
      const T e3 = -(e1 + e2);
      Principal<T> p{T{}, T{}, T{}, each(e3, [](double e) { return std::exp(e); })};
      for (int k = 0; k < 3; ++k) {
        if (mu[k] == 0) continue;
        const double a = alpha[k];
        const auto over = [a](double e) { return a == 0 ? e : std::expm1(a * e) / a; };  // (λ^α − 1)/α, ln λ for α = 0
        const T q1 = each(e1, over), q2 = each(e2, over), q3 = each(e3, over);
        p.tau1 += 2 * mu[k] * (q1 - q3);
        p.tau2 += 2 * mu[k] * (q2 - q3);
        if (a != 0) p.W += 2 * mu[k] / a * (q1 + q2 + q3);
        else p.W += mu[k] * (e1 * e1 + e2 * e2 + e3 * e3);
      }
      return p;
    });
  }
};

/// τ_i = E/(1 − ν²) (ln λ_i + ν ln λ_j), ln λ3 = −ν/(1 − ν) (ln λ1 + ln λ2).
struct HookeShell {
  double E, nu;
  double shear_modulus() const { return E / (2 * (1 + nu)); }
  double poisson() const { return nu; }
  template <class T>
  PALPATE_INLINE PlaneStress<T> operator()(const InPlane<T>& C) const {
    return by_principal(C, [this](const T& e1, const T& e2) {
      const double k = E / (1 - nu * nu), ratio = -nu / (1 - nu);
      const T t1 = k * (e1 + nu * e2), t2 = k * (e2 + nu * e1);
      return Principal<T>{t1, t2, 0.5 * (t1 * e1 + t2 * e2), each(ratio * (e1 + e2), [](double e) { return std::exp(e); })};
    });
  }
};

}  // namespace palpate::materials
