// Isotropic incompressible laws by principal stretches, and the homogeneous tests: with β_i = λ_i ∂W/∂λ_i,
// P = (β1 − β3)/λ for uniaxial (λ, λ^-½, λ^-½), equibiaxial (λ, λ, λ^-2) and pure shear (λ, 1, 1/λ); simple shear of amount γ:
// P = (β1 − β2)/(λ + 1/λ) with λ − 1/λ = γ. (Ogden 1984, Non-linear Elastic Deformations, §4.3, §7.2.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include <palpate/catalogue.hpp>
#include <loop/set/set.hpp>

namespace palpate::loop {

using Stretches = std::array<double, 3>;

struct Law {
  std::string name;                   ///< as palpate-solve has it
  std::vector<Parameter> parameters;  ///< those the loop fits
  Stretches (*beta)(const Stretches& lambda, std::span<const double> p);  ///< MPa
  double (*shear_modulus)(std::span<const double> p);                     ///< initial, MPa
};

/// The isotropic laws of the solver's catalogue: their incompressible parts.
const std::vector<Law>& laws();
/// Throws Failure(misuse) naming the nearest.
const Law& law_named(const std::string& name);

/// A change of the law that keeps its initial shear modulus μ. Every amplitude is zero for none.
struct Stiffening {
  double exponential = 0;   ///< b of Demiray: + μ/2 ((exp(b J) − 1)/b − J), J = I1 − 3
  double second = 0;        ///< share of the second invariant: + s μ/2 (I2 − I1)
  double square = 0;        ///< + c μ (I1 − 3)²
  double cube = 0;          ///< + c μ (I1 − 3)³
  double power = 0;         ///< Ogden's α − 2: + W_ogden(α) − W_ogden(2)
};

/// Nominal stress, MPa, of a test at stretch (or amount of shear) u.
double nominal_stress(Test test, double u, const Law& law, std::span<const double> p, const Stiffening& stiffening);

}  // namespace palpate::loop
