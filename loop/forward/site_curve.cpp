// Solved changes between the sizes and depths at which they were solved.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/site_curve.hpp>

#include <algorithm>

namespace palpate::loop {

double SolvedChange::Curve::at(double depth) const {
  const std::size_t i = std::upper_bound(depth_mm.begin(), depth_mm.end(), depth) - depth_mm.begin();
  if (i == 0) return log_ratio.front();
  if (i == depth_mm.size()) return log_ratio.back();
  const double share = (depth - depth_mm[i - 1]) / (depth_mm[i] - depth_mm[i - 1]);
  return (1 - share) * log_ratio[i - 1] + share * log_ratio[i];
}

double SolvedChange::log_ratio(double e, double depth) const {
  if (curves.empty() || e == 0) return 0;
  const Curve &first = curves.front(), &last = curves.back();
  const double per_first = first.at(depth) / first.amplitude;
  if (curves.size() == 1) return e * per_first;
  const double per_last = last.at(depth) / last.amplitude, B = (per_last - per_first) / (last.amplitude - first.amplitude), A = per_first - B * first.amplitude;
  if (e < 0) return A * e;
  if (e <= last.amplitude) return e * (A + B * e);
  const double tangent = A + 2 * B * last.amplitude;
  return last.amplitude * per_last + (tangent * per_last > 0 ? tangent : 0) * (e - last.amplitude);
}

}  // namespace palpate::loop
