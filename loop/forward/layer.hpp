// Rigid ball or flat punch, frictionless, on an elastic layer at small strain: the exact force over that on a half-space.
// φ(t) − 1/π ∫₀ᵃ φ(s) [K(t+s) + K(t−s)] ds = δ − t²/R, K(x) = ∫₀^∞ (1 − M(kh)) cos kx dk, F ∝ ∫₀ᵃ φ dt; a ball's edge is where
// φ(a) = 0. Compliance of the layer, κ = 3 − 4 ν:
//   bonded  M(α) = (2κ sinh 2α − 4α)/(2κ cosh 2α + 1 + κ² + 4α²);  sliding  M(α) = (cosh 2α − 1)/(sinh 2α + 2α).
// On a bed of springs k = μ/(q h) per area, in all directions, for ν = ½: displacements w = W(z) J₀(αr), u = −W′/α J₁(αr), W = (c₁ + c₂(1−z)) e^(−α(1−z)) + (c₃ + c₄ z) e^(−αz), whose stresses
// are −1 and 0 on top, k w and k u below: M = −2α W(1).
// (Lebedev and Ufliand 1958, J. Appl. Math. Mech. 22:442; Dhaliwal and Rau 1970, Int. J. Eng. Sci. 8:843; Johnson 1985 §5.8.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

namespace palpate::loop {

/// Factors over a range of contact radius, for one base and one Poisson's ratio; h = 1.
class LayerFactors {
 public:
  /// 1 − M of a layer over α.
  explicit LayerFactors(const std::function<double(double)>& one_minus_compliance);
  /// Force of a ball over Hertz's, at χ = √(Rδ)/h up to 3 (the last value holds beyond).
  double ball(double chi) const;
  /// Force of a flat punch over that on a half-space, at a/h up to 3.
  double punch(double a_over_h) const;
  /// Contact area of a ball over Hertz's πRδ, at χ as `ball`.
  double area(double chi) const;

 private:
  std::vector<double> a_, chi_, ball_, punch_, area_;
};

/// Factor of a ball (at χ) or a flat punch (at a/h) for any ν from 0.2 to ½, between tables 0.02 apart that are built once and kept.
double layer_factor(bool flat, bool bonded, double nu, double at);

/// Force of a ball or flat punch on an incompressible layer on a bed of springs over that on the same layer bonded to a rigid base; `softness` q = μ/(k h) up to 1.
double bed_factor(bool flat, double softness, double at);

/// Contact area of a ball over πRδ, likewise.
double layer_area(bool bonded, double nu, double chi);

/// A ball's factor at χ = √(Rδ)/h by the series of Dimitriadis et al. 2002 (Biophys. J. 82:2798, eq. 10 to 13): good to 2 % of the exact one up to χ = ¼, 8 % too soft at ½.
double dimitriadis_factor(bool bonded, double nu, double chi);

}  // namespace palpate::loop
