// Otsu's threshold: the cut with the largest variance between classes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/histogram.hpp>

#include <algorithm>
#include <cmath>

namespace palpate {

Histogram histogram_of(const std::vector<float>& values, int bins) {
  Histogram h{0, 0, std::vector<std::size_t>(bins, 0)};
  if (values.empty()) return h;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  h.min = *low;
  h.max = *high;
  const double scale = h.max > h.min ? bins / (h.max - h.min) : 0;
  for (float v : values) ++h.bins[std::min(bins - 1, static_cast<int>((v - h.min) * scale))];
  return h;
}

std::optional<double> otsu_threshold(const Histogram& histogram) {
  if (!(histogram.max > histogram.min)) return std::nullopt;
  const auto& bins = histogram.bins;
  double total = 0, moment = 0;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    total += bins[b];
    moment += (b + 0.5) * bins[b];
  }
  double best = -1, below = 0, below_moment = 0;
  std::size_t first_best = 0, last_best = 0;
  for (std::size_t cut = 1; cut < bins.size(); ++cut) {
    below += bins[cut - 1];
    below_moment += (cut - 0.5) * bins[cut - 1];
    if (below == 0 || below == total) continue;
    const double mu0 = below_moment / below, mu1 = (moment - below_moment) / (total - below);
    const double between = below * (total - below) * (mu1 - mu0) * (mu1 - mu0);
    if (between > best) {
      best = between;
      first_best = cut;
    }
    if (between == best) last_best = cut;
  }
  return histogram.min + 0.5 * static_cast<double>(first_best + last_best) * histogram.bin_width();
}

float percentile(std::vector<float> values, double fraction) {
  if (values.empty()) return 0;
  const auto nth = values.begin() + std::lround(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

Statistics statistics_of(const std::vector<float>& values) {
  Statistics s;
  if (values.empty()) return s;
  s.count = values.size();
  double sum = 0, squares = 0;
  for (float v : values) sum += v;
  s.mean = sum / static_cast<double>(s.count);
  for (float v : values) squares += (v - s.mean) * (v - s.mean);
  s.sd = std::sqrt(squares / static_cast<double>(s.count));
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  s.min = *low;
  s.max = *high;
  return s;
}

}  // namespace palpate
