// Runs left out in turn: how well the others predict them, and how much an effect hangs on one of them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/methods/problem.hpp>

namespace palpate::loop {

struct LeftOut {
  double excess = 0;             ///< sum over the runs left out of (whitened squares − blocks); NaN for one run
  double amplitude_over_sd = 0;  ///< of the last effect: jackknife_ratio of its amplitudes without each run; 0 without effects
};

/// Every fitted run is left out once and the model fitted anew without it.
LeftOut left_out(const Problem& problem, const Model& model, int threads);
double left_out_excess(const Problem& problem, const Model& model, int threads);

/// Mean of estimates without one datum each over the jackknife's standard deviation, √((n−1)/n Σ(eᵢ − ē)²) (Tukey 1958; Efron and Stein 1981, Ann. Stat. 9:586).
double jackknife_ratio(const std::vector<double>& estimates_without_one);

}  // namespace palpate::loop
