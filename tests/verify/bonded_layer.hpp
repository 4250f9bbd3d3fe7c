// Rigid axisymmetric tool, frictionless, on an incompressible layer bonded to a rigid base, at small strain: the exact force.
// With p(r) = ∫ k A(k) J0(kr) dk, A(k) = ∫₀ᵃ φ(t) cos kt dt and the layer's compliance M(kh), the mixed problem becomes
//   φ(t) − 1/π ∫₀ᵃ φ(s) [K(t+s) + K(t−s)] ds = E/(π(1−ν²)) · (δ − t²/R),  K(x) = ∫₀^∞ (1 − M(kh)) cos kx dk,  F = 2π ∫₀ᵃ φ dt,
//   M(α) = (sinh 2α − 2α)/(cosh 2α + 1 + 2α²) for ν = ½; a ball's edge is where φ(a) = 0.
// (Lebedev and Ufliand 1958, J. Appl. Math. Mech. 22:442; Dhaliwal and Rau 1970, Int. J. Eng. Sci. 8:843.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <vector>

namespace palpate::verify {

/// Gauss-Legendre points and weights on [0, 1] (Golub and Welsch 1969).
struct GaussRule {
  Eigen::VectorXd x, w;
  explicit GaussRule(int n) {
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
    for (int i = 1; i < n; ++i) T(i, i - 1) = T(i - 1, i) = i / std::sqrt(4.0 * i * i - 1);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(T);
    x = 0.5 * (eigen.eigenvalues().array() + 1);
    w = eigen.eigenvectors().row(0).cwiseAbs2().transpose();
  }
};

/// K(x) for h = 1.
inline double layer_kernel(double x) {
  static const GaussRule rule(400);
  constexpr double end = 40;  // 1 − M falls as α² e^(−2α)
  double sum = 0;
  for (int i = 0; i < rule.x.size(); ++i) {
    const double a = end * rule.x(i), e = std::exp(-2 * a);
    const double M = a < 1e-3 ? 2.0 / 3 * a * a * a : (1 - e * e - 4 * a * e) / (1 + e * e + (2 + 4 * a * a) * e);
    sum += end * rule.w(i) * (1 - M) * std::cos(a * x);
  }
  return sum;
}

/// φ at the Gauss points of [0, a] and its value at a, for unit E/(π(1−ν²)) and the right-hand side constant + square t².
struct LayerSolution {
  double integral, at_edge;
};
inline LayerSolution solve_layer(double a, double constant, double square) {
  static const GaussRule rule(24);
  const int n = rule.x.size();
  const auto kernel = [](double t, double s) { return (layer_kernel(t + s) + layer_kernel(t - s)) / M_PI; };
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd b(n);
  for (int i = 0; i < n; ++i) {
    const double t = a * rule.x(i);
    b(i) = constant + square * t * t;
    for (int j = 0; j < n; ++j) A(i, j) -= a * rule.w(j) * kernel(t, a * rule.x(j));
  }
  const Eigen::VectorXd phi = A.partialPivLu().solve(b);
  double edge = constant + square * a * a;
  for (int j = 0; j < n; ++j) edge += a * rule.w(j) * phi(j) * kernel(a, a * rule.x(j));
  return {a * rule.w.dot(phi), edge};
}

/// Force of a flat punch of radius a on a layer of height h, over that on a half-space, 8 a μ δ.
inline double punch_on_layer_factor(double a_over_h) { return solve_layer(a_over_h, 1, 0).integral / a_over_h; }

/// Force of a ball over Hertz's 16/9 E √R δ^1.5, at χ = √(Rδ)/h.
inline double ball_on_layer_factor(double chi) {
  // h = 1, R = 1: δ = χ²; by linearity φ = δ φ₁ − φ₂, and a is where φ(a) = 0.
  const double delta = chi * chi;
  const auto edge = [&](double a) { return solve_layer(a, delta, -1).at_edge; };
  double low = 0.5 * chi, high = 3 * chi;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (edge(middle) > 0 ? low : high) = middle;
  }
  return solve_layer(low, delta, -1).integral / (2.0 / 3 * std::pow(chi, 3));
}

}  // namespace palpate::verify
