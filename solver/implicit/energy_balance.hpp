// Balance of energy along a run: what tools, loads and supports bring against what is stored and lost, ∫ f·dx = ΔE + D. Stored energy is that
// of the laws, a state's own; work is summed by the trapezoid rule, corrected by the second difference of the last three states:
// T₁ + T₂ + (T₁ + T₂ − T) (h₁³ + h₂³)/((h₁ + h₂)³ − h₁³ − h₂³), T over both steps at once. (Richardson 1911.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include <solver/archive.hpp>
#include <solver/implicit/steps.hpp>

namespace palpate::implicit {

class EnergyBalance {
 public:
  using Works = std::array<double, channel_count>;  ///< N mm, by Channel

  /// `rest`: where the run begins and when, free of forces.
  EnergyBalance(const Assembly& assembly, const State& rest);

  /// The next state. What is missing after a step by drag was lost in a jump.
  void add(const Assembly& assembly, const Accepted& found);
  /// The state lives on another mesh now; returns the change of the energy stored, N mm.
  double remeshed(const Assembly& assembly, const State& state, const Equations& equations);

  /// Work so far: of the first channels on the organs, of the others by them.
  Works works() const;
  const Stored& stored() const { return stored_; }
  double in_slips() const { return in_slips_; }
  bool tissue_remembers() const { return tissue_remembers_; }
  double lost_in_jumps() const { return jumps_; }
  double by_remeshing() const { return remeshing_; }
  /// What is missing: brought less stored and lost, N mm.
  double imbalance() const;
  /// Of the trapezoid rule, N mm: as much as that, or less, may the works be wrong by.
  double correction() const;
  /// Largest |imbalance| on the way, of the largest energy on the way.
  double worst_imbalance() const;
  void keep(Archive& archive);

 private:
  struct Moment {
    double time = 0;
    Channels channels;
  };
  static Works between(const Moment& a, const Moment& b);
  double stored_sum() const;
  double balance(const Works& works) const;
  void take(const Assembly& assembly, const State& state, const Equations& equations);

  Moment last_, before_;
  bool before_known_ = false;    ///< of the last step there is a step before
  bool corrected_ = false;       ///< so is the last step
  Works trapezoid_{}, correction_{};
  Stored stored_;
  double in_slips_ = 0, jumps_ = 0, remeshing_ = 0, worst_ = 0, largest_ = 0;
  bool tissue_remembers_ = false;
};

}  // namespace palpate::implicit
