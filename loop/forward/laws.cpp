// β_i = λ_i ∂W/∂λ_i of every isotropic law, and the homogeneous tests.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/laws.hpp>

#include <cmath>

#include <palpate/errors.hpp>
#include <palpate/nearest.hpp>

namespace palpate::loop {
namespace {

double first(const Stretches& l) { return l[0] * l[0] + l[1] * l[1] + l[2] * l[2]; }
/// 2 W1 λ² + 2 W2 λ² (I1 − λ²), from W1 = ∂W/∂I1 and W2 = ∂W/∂I2.
Stretches from_invariants(const Stretches& l, double W1, double W2) {
  Stretches beta;
  const double I1 = first(l);
  for (int i = 0; i < 3; ++i) beta[i] = 2 * l[i] * l[i] * (W1 + W2 * (I1 - l[i] * l[i]));
  return beta;
}
/// 2 μ/α λ^α, logarithmic for α = 0.
Stretches ogden_term(const Stretches& l, double mu, double alpha) {
  Stretches beta;
  for (int i = 0; i < 3; ++i) beta[i] = std::abs(alpha) < 1e-9 ? 2 * mu * std::log(l[i]) : 2 * mu / alpha * std::pow(l[i], alpha);
  return beta;
}

Stretches neo_hookean(const Stretches& l, std::span<const double> p) { return from_invariants(l, p[0] / 2, 0); }
Stretches mooney_rivlin(const Stretches& l, std::span<const double> p) { return from_invariants(l, p[0], p[1]); }
Stretches yeoh(const Stretches& l, std::span<const double> p) {
  const double J = first(l) - 3;
  return from_invariants(l, p[0] + J * (2 * p[1] + 3 * p[2] * J), 0);
}
Stretches fung_demiray(const Stretches& l, std::span<const double> p) {
  return from_invariants(l, p[0] / 2 * std::exp(std::min(p[1] * (first(l) - 3), 50.0)), 0);
}
Stretches ogden(const Stretches& l, std::span<const double> p) { return ogden_term(l, p[0], p[1]); }
Stretches hooke(const Stretches& l, std::span<const double> p) { return ogden_term(l, p[0] / 3, 0); }

Parameter modulus(const char* name, double typical, const char* meaning) { return {name, "MPa", {1e-7, 1e3}, typical, meaning}; }

}  // namespace

const std::vector<Law>& laws() {
  static const std::vector<Law> list = {
      {"neo_hookean", {modulus("mu", 0.01, "initial shear modulus")}, neo_hookean, [](std::span<const double> p) { return p[0]; }},
      {"mooney_rivlin", {modulus("C10", 0.004, "of I1"), modulus("C01", 0.001, "of I2")}, mooney_rivlin,
       [](std::span<const double> p) { return 2 * (p[0] + p[1]); }},
      {"yeoh", {modulus("C10", 0.005, "of I1 − 3"), modulus("C20", 0.001, "of (I1 − 3)²"), modulus("C30", 1e-5, "of (I1 − 3)³")}, yeoh,
       [](std::span<const double> p) { return 2 * p[0]; }},
      {"fung_demiray", {modulus("mu", 0.01, "initial shear modulus"), {"b", "1", {1e-3, 100}, 1, "rate of stiffening"}}, fung_demiray,
       [](std::span<const double> p) { return p[0]; }},
      {"ogden", {modulus("mu1", 0.01, "initial shear modulus"), {"alpha1", "1", {0.05, 50}, 3, "power"}}, ogden,
       [](std::span<const double> p) { return p[0]; }},
      {"hooke", {modulus("E", 0.03, "Young's modulus")}, hooke, [](std::span<const double> p) { return p[0] / 3; }},
      {"hooke_linear", {modulus("E", 0.03, "Young's modulus")}, hooke, [](std::span<const double> p) { return p[0] / 3; }},
  };
  return list;
}

const Law& law_named(const std::string& name) {
  std::vector<std::string> names;
  for (const Law& law : laws()) {
    if (law.name == name) return law;
    names.push_back(law.name);
  }
  throw Failure(ExitCode::misuse, "the loop has no law " + name, "[specimen] law", "did you mean " + nearest_name(name, names) + "?");
}

namespace {

Stretches stiffened(const Stretches& l, const Law& law, std::span<const double> p, const Stiffening& s) {
  Stretches beta = law.beta(l, p);
  const double mu = law.shear_modulus(p), J = first(l) - 3;
  const auto add = [&](const Stretches& more, double factor) {
    for (int i = 0; i < 3; ++i) beta[i] += factor * more[i];
  };
  double W1 = mu * J * (2 * s.square + 3 * s.cube * J) - s.second * mu / 2;
  if (s.exponential != 0) W1 += mu / 2 * std::expm1(std::min(s.exponential * J, 50.0));
  if (W1 != 0 || s.second != 0) add(from_invariants(l, W1, s.second * mu / 2), 1);
  if (s.power != 0) {
    add(ogden_term(l, mu, 2 + s.power), 1);
    add(ogden_term(l, mu, 2), -1);
  }
  return beta;
}

}  // namespace

double nominal_stress(Test test, double u, const Law& law, std::span<const double> p, const Stiffening& s) {
  if (test == Test::simple_shear) {
    const double l = u / 2 + std::sqrt(1 + u * u / 4);
    const Stretches beta = stiffened({l, 1 / l, 1}, law, p, s);
    return (beta[0] - beta[1]) / (l + 1 / l);
  }
  const double l = std::max(u, 1e-3);
  const Stretches of_test = test == Test::equibiaxial  ? Stretches{l, l, 1 / (l * l)}
                            : test == Test::pure_shear ? Stretches{l, 1, 1 / l}
                                                       : Stretches{l, 1 / std::sqrt(l), 1 / std::sqrt(l)};
  const Stretches beta = stiffened(of_test, law, p, s);
  return (beta[0] - beta[2]) / l;
}

}  // namespace palpate::loop
