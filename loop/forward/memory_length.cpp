// A ramp of 4 s, a hold of 10 s and a way back of 4 s under a tissue of which a fifth relaxes in 4 s; the row's length by golden section (Kiefer 1953).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/memory_length.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <loop/forward/row.hpp>

namespace palpate::loop {
namespace {

constexpr double g = 0.2, tau_s = 4, hold_s = 10;

Row row_of(const SolvedCurve& own, double deepest, double length) {
  constexpr int springs = 64;
  std::vector<double> depths, forces;
  for (int i = 0; i <= springs; ++i) {
    depths.push_back(1.001 * deepest * std::pow(static_cast<double>(i) / springs, 1.4));
    forces.push_back(i == 0 ? 0 : own.at(depths.back()));
  }
  Tissue tissue;
  tissue.prony = {{g, tau_s}};
  return Row(springs_of(depths, forces), tissue, deepest, true, length);
}

/// Rms over the largest force.
double missed(const SolvedMotion& relaxed, Row row) {
  constexpr int parts = 6;
  double squares = 0, largest = 0;
  for (std::size_t i = 1; i < relaxed.t_s.size(); ++i) {
    const double dt = relaxed.t_s[i] - relaxed.t_s[i - 1], du = relaxed.depth_mm[i] - relaxed.depth_mm[i - 1];
    double force = 0;
    for (int k = 1; k <= parts; ++k) force = row.advance(relaxed.depth_mm[i - 1] + du * k / parts, dt / parts);
    squares += (force - relaxed.force_N[i]) * (force - relaxed.force_N[i]);
    largest = std::max(largest, relaxed.force_N[i]);
  }
  return std::sqrt(squares / static_cast<double>(relaxed.t_s.size() - 1)) / largest;
}

}  // namespace

std::string relaxing_words() {
  std::ostringstream out;
  out << "[[effect]]\nname = \"prony\"\ng = " << g << "\ntau_s = " << tau_s << "\n";
  return out.str();
}

std::string relaxing_motion(double deepest) {
  std::ostringstream out;
  out.precision(12);
  out << "path = [[0, 0], [" << tau_s << ", " << deepest << "], [" << tau_s + hold_s << ", " << deepest << "], [" << 2 * tau_s + hold_s << ", 0]]\n[steps]\ntimes_s = [";
  constexpr int moving = 8, still = 4;
  for (int k = 1; k <= moving; ++k) out << tau_s * k / moving << ", ";
  for (int k = 1; k <= still; ++k) out << tau_s + hold_s * std::pow(2.0, k - still) << ", ";
  for (int k = 1; k <= moving; ++k) out << tau_s + hold_s + tau_s * k / moving << (k < moving ? ", " : "]\nmost_cuts = 8\nframes = 1\n");
  return out.str();
}

MemoryLength memory_length(const SolvedMotion& relaxed, const SolvedCurve& own, double deepest) {
  const auto miss = [&](double log_length) { return missed(relaxed, row_of(own, deepest, std::exp(log_length))); };
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double low = std::log(0.2 * deepest), high = std::log(20 * deepest);
  double a = high - golden * (high - low), b = low + golden * (high - low), at_a = miss(a), at_b = miss(b);
  while (high - low > 0.02) {
    if (at_a < at_b) high = b, b = a, at_b = at_a, at_a = miss(a = high - golden * (high - low));
    else low = a, a = b, at_a = at_b, at_b = miss(b = low + golden * (high - low));
  }
  MemoryLength found{std::exp(0.5 * (low + high)), missed(relaxed, row_of(own, deepest, 0)), 0};
  found.after = miss(std::log(found.mm));
  if (!(found.after < found.before)) found = {0, found.before, found.before};
  return found;
}

}  // namespace palpate::loop
