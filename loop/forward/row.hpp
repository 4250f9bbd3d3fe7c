// A contact with memory as a row of independent springs: spring i stands δ_i below the first contact and has stiffness
// w_i = F″(δ_i) Δδ, so that Σ w_i (δ − δ_i)₊ is the elastic curve F(δ) itself; every spring has the tissue's memory for itself.
// For Hertz' curve this is the method of dimensionality reduction, exact for any history of a viscoelastic half-space, unloading
// included (Popov and Heß 2015, ch. 7; Ting 1966; Argatov and Popov 2016). For layers and finite strain it is a shortcut.
// At large strain stress is remembered as the second Piola-Kirchhoff one S, which the solid bears on λ of what it was: with a length ℓ a spring of elongation e has
// S = e (1 + e/ℓ), λ = 1/(1 + e/ℓ), S relaxes and λ S presses, so that what has relaxed is missed the more the further the tool is drawn back (decision 045).
// A homogeneous test is a row of one spring that never lets go, its elongation being the elastic stress.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include <loop/forward/tissue.hpp>

namespace palpate::loop {

struct Spring {
  double start = 0;      ///< δ_i
  double stiffness = 1;  ///< w_i
  double reach = 0;      ///< elongation at which half of it has let go (adhesion)
  double fade = 0;       ///< further elongation between the first and the last of it: a ring is left by the edge little by little
};

/// Springs that follow the convex curve F(δ), given at depths[0] = 0 < depths[1] < …
std::vector<Spring> springs_of(std::span<const double> depths, std::span<const double> forces);

class Row {
 public:
  /// `scale` is the deepest elongation of the set: Mullins' scale and the yield of permanent set are relative to it. `lets_go`: springs
  /// carry no tension beyond their reach. `springs` stand in order of their start. `memory_mm`: ℓ of a tissue that relaxes; 0: none.
  Row(std::vector<Spring> springs, const Tissue& tissue, double scale, bool lets_go, double memory_mm = 0);
  /// The force after a further `dt` when the tool goes straight to `depth`; nothing is remembered.
  double trial(double depth, double dt) const;
  /// The same, remembered.
  double advance(double depth, double dt);

 private:
  struct Memory {
    double elongation = 0, largest = 0, set = 0;
    bool touching = false;
  };
  double elastic(double depth) const;
  double over_length(double elongation) const { return elongation > 0 ? elongation * per_length_ : 0; }
  bool only_relaxes() const { return lets_go_ && !has_reach_ && !(tissue_.mullins > 0) && !(tissue_.set_fraction > 0); }
  double carried(Memory& after, const double* maxwell) const;
  double step(std::size_t i, Memory& after, double* maxwell, double depth) const;
  double advance_relaxing(double depth);
  std::size_t in_play(double depth) const;
  void prepare(double dt) const;

  std::vector<Spring> springs_;
  std::vector<double> stiffness_sum_, moment_sum_;  ///< Σ w, Σ w δ of the springs before each: the elastic curve
  std::vector<Memory> memory_;
  std::vector<double> maxwell_;  ///< elastic elongation of each Prony term, springs × terms; terms × springs where nothing else remembers
  std::vector<double> start_, elongation_, change_, sum_, free_;  ///< of each spring, for advance_relaxing
  const Tissue tissue_;
  double scale_, instant_, per_length_;
  bool lets_go_, has_memory_, has_reach_ = false;
  std::size_t touched_ = 0;  ///< springs from here on have never been touched
  mutable double prepared_ = -1;
  mutable std::vector<double> kept_, gained_;  ///< exp(−dt/τ) and (1 − exp(−dt/τ)) τ/dt of the current step
};

}  // namespace palpate::loop
