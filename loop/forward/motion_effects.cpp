// Rate and friction over the samples of a run.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/motion_effects.hpp>

#include <algorithm>
#include <cmath>

namespace palpate::loop {
namespace {

/// Speed at a sample: of the side on which it changes less, so that a turn of the tool between two samples spoils neither (Harten et al. 1987).
double speed(const Run& run, const Path& depth, std::size_t i) {
  const auto over = [&](std::size_t k) { return (depth[k] - depth[k - 1]) / (run.t[k] - run.t[k - 1]); };
  const std::size_t last = depth.size() - 1;
  if (last == 0) return 0;
  if (i == 0) return over(1);
  if (i == last) return over(last);
  const double left = i >= 2 ? std::abs(over(i) - over(i - 1)) : 0, right = i + 2 <= last ? std::abs(over(i + 2) - over(i + 1)) : 0;
  return left <= right ? over(i) : over(i + 1);
}

}  // namespace

void add_rate(const Run& run, const Tissue& tissue, const Path& depth, double scale, Path& force) {
  if (tissue.rate == 0 || !run.timed) return;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double v = speed(run, depth, i) / scale;
    const double surplus = std::log1p(std::abs(v) / tissue.rate_reference_per_s);
    force[i] *= 1 + tissue.rate * (v > 0 ? surplus : -surplus);
  }
}

void add_friction(const Site& site, const Tissue& tissue, const Path& depth, Path& force) {
  if (tissue.friction == 0 || site.tool.is_flat()) return;
  const double mu = tissue.friction, R = site.tool.radius_mm, turn = tissue.friction_slips ? 0.05 : std::max(29 * mu * mu, 1e-3);
  double s = 0, before = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double d = std::max(depth[i], 0.0), x = std::min(d / R, 1.0);
    const double most = tissue.friction_slips ? 3 * M_PI / 16 * mu * std::sqrt(x) : solved_friction(mu, x);
    if (!(d > 0)) s = 0;
    else if (tissue.friction_slips) s = std::clamp(s + (d - before) / (turn * std::max(d, before)), -1.0, 1.0);
    else s = before > 0 ? std::clamp(s + std::log(d / before) / turn, -1.0, 1.0) : 1;
    before = d;
    force[i] *= 1 + most * s;
  }
}

}  // namespace palpate::loop
