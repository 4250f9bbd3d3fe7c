// Fast fluctuations of a run, and long runs averaged over neighbouring samples: forward models cost time per sample.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/set/set.hpp>

namespace palpate::loop {

/// Standard deviation of one sample from fourth differences (median; blind to smooth curves), not below what the steps of a coarse
/// converter hide (step/√12).
double fast_sd(const std::vector<double>& values);

/// First sample of each stretch of one phase, then the number of samples. Stretches under three samples join the one before.
std::vector<int> stretches(const Run& run);

/// Fills `averaged` and `fast_sd_N` of every run, and averages runs of more than 480 samples over groups that end where a phase does: each a 480th of the samples at most, or
/// of the way that u goes there and back, so that fast ramps of a long run keep their samples.
void thin(Set& set);

}  // namespace palpate::loop
