// Intensities in bins: Otsu's threshold, percentiles, moments.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace palpate {

/// Equal bins from the smallest to the largest value; the largest value lies in the last bin.
struct Histogram {
  double min = 0, max = 0;
  std::vector<std::size_t> bins;
  double bin_width() const { return (max - min) / static_cast<double>(bins.size()); }
};

Histogram histogram_of(const std::vector<float>& values, int bins);

/// The cut t = min + n·width that maximises the variance between the classes below and above,
/// σ_B² = ω₀ ω₁ (μ₁ − μ₀)²; the middle of the best cuts when several are equally good. Empty when all values are equal.
/// N. Otsu, A threshold selection method from gray-level histograms, IEEE Trans. SMC 9 (1979), eq. 14.
std::optional<double> otsu_threshold(const Histogram& histogram);

/// The value below which `fraction` (0…1) of the values lie; of no values, 0. Values between two samples are not interpolated.
float percentile(std::vector<float> values, double fraction);

struct Statistics {
  std::size_t count = 0;
  double mean = 0, sd = 0, min = 0, max = 0;
};

/// Mean, standard deviation (of the population) and extremes; zeros for no values.
Statistics statistics_of(const std::vector<float>& values);

}  // namespace palpate
