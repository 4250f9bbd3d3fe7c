// One step of every spring (elongations are those of S where there is a length): Maxwell branches, softening by the largest elongation so far, set, letting go.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/row.hpp>

#include <algorithm>
#include <cmath>

namespace palpate::loop {

std::vector<Spring> springs_of(std::span<const double> depths, std::span<const double> forces) {
  std::vector<Spring> springs;
  double before = 0;
  for (std::size_t i = 0; i + 1 < depths.size(); ++i) {
    const double slope = (forces[i + 1] - forces[i]) / (depths[i + 1] - depths[i]);
    springs.push_back({depths[i], slope - before});
    before = slope;
  }
  return springs;
}

namespace {
constexpr std::size_t most_terms = 8;
}

Row::Row(std::vector<Spring> springs, const Tissue& tissue, double scale, bool lets_go, double memory_mm)
    : springs_(std::move(springs)), tissue_(tissue), scale_(scale), instant_(1), per_length_(memory_mm > 0 && !tissue.prony.empty() ? 1 / memory_mm : 0), lets_go_(lets_go),
      has_memory_(!tissue.prony.empty() || tissue.mullins > 0 || tissue.set_fraction > 0), kept_(tissue.prony.size()), gained_(tissue.prony.size()) {
  for (const PronyTerm& term : tissue_.prony) instant_ -= term.g;
  stiffness_sum_ = moment_sum_ = {0};
  for (const Spring& s : springs_) {
    stiffness_sum_.push_back(stiffness_sum_.back() + s.stiffness);
    moment_sum_.push_back(moment_sum_.back() + s.stiffness * s.start);
    has_reach_ = has_reach_ || s.reach > 0;
  }
  has_memory_ = has_memory_ || has_reach_;
  if (!has_memory_) return;
  if (only_relaxes()) {
    for (const Spring& s : springs_) start_.push_back(s.start);
    elongation_ = change_ = sum_ = free_ = std::vector<double>(springs_.size(), 0.0);
  }
  memory_.resize(springs_.size());
  maxwell_.assign(springs_.size() * kept_.size(), 0);
}

void Row::prepare(double dt) const {
  if (dt == prepared_) return;
  prepared_ = dt;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const double ratio = dt / tissue_.prony[k].tau_s;
    kept_[k] = std::exp(-ratio);
    gained_[k] = ratio > 1e-9 ? -std::expm1(-ratio) / ratio : 1;
  }
}

/// Σ w (δ − δ_i)₊ by the running sums.
double Row::elastic(double depth) const {
  if (!lets_go_) return springs_[0].stiffness * depth;
  const auto above = std::lower_bound(springs_.begin(), springs_.end(), depth, [](const Spring& s, double d) { return s.start < d; });
  const std::size_t n = above - springs_.begin();
  return stiffness_sum_[n] * depth - moment_sum_[n];
}

/// Spring force over stiffness of a state whose elongation and Maxwell branches are up to date; updates largest and set.
double Row::carried(Memory& m, const double* maxwell) const {
  double e = instant_ * m.elongation;
  for (std::size_t k = 0; k < kept_.size(); ++k) e += tissue_.prony[k].g * maxwell[k];
  const double size = std::abs(m.elongation);
  if (size > m.largest && !(lets_go_ && m.elongation < 0)) {
    m.largest = size;
    m.set = tissue_.set_fraction * std::max(0.0, m.largest - tissue_.set_yield * scale_);
  }
  if (tissue_.mullins > 0 && size < m.largest) {  // η = 1 − (1/r) erf((W_max − W)/m), W = ½ e² (Ogden and Roxburgh 1999, eq. 3.10)
    const double width = tissue_.mullins_scale * scale_;
    e *= 1 - tissue_.mullins * std::erf((m.largest * m.largest - size * size) / (2 * width * width));
  }
  return e - (m.elongation < 0 && !lets_go_ ? -m.set : m.set);  // a contact keeps what was pressed in, a test piece what was stretched or pressed
}

/// `maxwell` are the branches before, and become those after.
double Row::step(std::size_t i, Memory& m, double* maxwell, double depth) const {
  const Spring& spring = springs_[i];
  const Memory before = m;
  double old[most_terms];
  const std::size_t terms = kept_.size();
  const double stretched = lets_go_ ? depth - spring.start : depth, larger = 1 + over_length(stretched);
  m.elongation = stretched * larger;
  for (std::size_t k = 0; k < terms; ++k) {
    old[k] = maxwell[k];
    maxwell[k] = kept_[k] * maxwell[k] + gained_[k] * (m.elongation - before.elongation);
  }
  const double force = carried(m, maxwell);
  const bool sticks = spring.reach > 0 && (before.touching || !tissue_.adhesion_on_retract_only);
  const double last = sticks ? -spring.reach - 0.5 * spring.fade : 0;
  if (!lets_go_ || force > last) {
    m.touching = true;
    const double held = sticks && force < last + spring.fade ? std::min((force - last) / spring.fade, 1.0) : 1;
    return spring.stiffness * held * force / larger;
  }
  m = before;  // free: the elongation at which it carries nothing, instant e + Σ g (kept q + gained (e − e₀)) = set
  double constant = -before.set, slope = instant_;
  for (std::size_t k = 0; k < terms; ++k) {
    const double g = tissue_.prony[k].g;
    constant += g * (kept_[k] * old[k] - gained_[k] * before.elongation);
    slope += g * gained_[k];
  }
  m.touching = false;
  m.elongation = -constant / slope;
  for (std::size_t k = 0; k < terms; ++k) maxwell[k] = kept_[k] * old[k] + gained_[k] * (m.elongation - before.elongation);
  return 0;
}

/// Springs that were touched before or are now; those behind them carry nothing (with adhesion on approach all may).
std::size_t Row::in_play(double depth) const {
  std::size_t n = touched_;
  if (!lets_go_ || !tissue_.adhesion_on_retract_only) return springs_.size();
  while (n < springs_.size() && springs_[n].start < depth) ++n;
  return n;
}

/// All springs at once: force instant e + Σ g q; where it is not positive the spring is free and goes to where it carries nothing.
double Row::advance_relaxing(double depth) {
  const std::size_t n = touched_, all = springs_.size();
  double slope = instant_;
  for (std::size_t i = 0; i < n; ++i) {
    const double stretched = depth - start_[i], S = stretched * (1 + over_length(stretched));
    change_[i] = S - elongation_[i];
    sum_[i] = instant_ * S;
    free_[i] = 0;
  }
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const double g = tissue_.prony[k].g, kept = kept_[k], gained = gained_[k];
    const double* q = maxwell_.data() + k * all;
    slope += g * gained;
    for (std::size_t i = 0; i < n; ++i) {
      sum_[i] += g * (kept * q[i] + gained * change_[i]);
      free_[i] += g * (kept * q[i] - gained * elongation_[i]);
    }
  }
  double force = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_free = !(sum_[i] > 0);
    force += is_free ? 0 : springs_[i].stiffness * sum_[i] / (1 + over_length(depth - start_[i]));
    change_[i] = is_free ? -free_[i] / slope - elongation_[i] : change_[i];
    elongation_[i] += change_[i];
  }
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    double* q = maxwell_.data() + k * all;
    for (std::size_t i = 0; i < n; ++i) q[i] = kept_[k] * q[i] + gained_[k] * change_[i];
  }
  return force;
}

double Row::trial(double depth, double dt) const {
  if (!has_memory_) return elastic(depth);
  if (only_relaxes()) {
    Row copy = *this;
    return copy.advance(depth, dt);
  }
  prepare(dt);
  double force = 0, maxwell[most_terms];
  const std::size_t terms = kept_.size(), count = in_play(depth);
  for (std::size_t i = 0; i < count; ++i) {
    Memory after = memory_[i];
    std::copy_n(maxwell_.data() + i * terms, terms, maxwell);
    force += step(i, after, maxwell, depth);
  }
  return force;
}

double Row::advance(double depth, double dt) {
  if (!has_memory_) return elastic(depth);
  prepare(dt);
  double force = 0;
  touched_ = in_play(depth);
  if (only_relaxes()) return advance_relaxing(depth);
  for (std::size_t i = 0; i < touched_; ++i) force += step(i, memory_[i], maxwell_.data() + i * kept_.size(), depth);
  return force;
}

}  // namespace palpate::loop
