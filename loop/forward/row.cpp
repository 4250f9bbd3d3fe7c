// One step of every spring: Maxwell branches, softening by the largest elongation so far, set, letting go.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/row.hpp>

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

void add_adhesion(std::vector<Spring>& springs, double work_J_per_m2, double reduced_modulus_MPa) {
  if (!(work_J_per_m2 > 0)) return;
  const double work = 1e-3 * work_J_per_m2;  // N/mm
  double slope = 0;
  for (Spring& spring : springs) {
    slope += spring.stiffness;
    spring.reach = std::sqrt(2 * M_PI * std::max(slope, 0.0) / (2 * reduced_modulus_MPa) * work / reduced_modulus_MPa);
  }
}

Row::Row(std::vector<Spring> springs, const Tissue& tissue, double scale, bool lets_go)
    : springs_(std::move(springs)), memory_(springs_.size()), tissue_(tissue), scale_(scale), instant_(1), lets_go_(lets_go),
      kept_(tissue.prony.size()), gained_(tissue.prony.size()) {
  for (const PronyTerm& term : tissue_.prony) instant_ -= term.g;
  for (Memory& m : memory_) m.maxwell.assign(tissue_.prony.size(), 0);
}

void Row::prepare(double dt) const {
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const double ratio = dt / tissue_.prony[k].tau_s;
    kept_[k] = std::exp(-ratio);
    gained_[k] = ratio > 1e-9 ? -std::expm1(-ratio) / ratio : 1;
  }
}

/// Spring force over stiffness of a state whose elongation and Maxwell branches are up to date; updates largest and set.
double Row::carried(Memory& m) const {
  double e = instant_ * m.elongation;
  for (std::size_t k = 0; k < kept_.size(); ++k) e += tissue_.prony[k].g * m.maxwell[k];
  const double size = std::abs(m.elongation);
  if (size > m.largest) {
    m.largest = size;
    m.set = tissue_.set_fraction * std::max(0.0, m.largest - tissue_.set_yield * scale_);
  }
  if (tissue_.mullins > 0) {  // η = 1 − (1/r) erf((W_max − W)/m), W = ½ e² (Ogden and Roxburgh 1999, eq. 3.10)
    const double width = tissue_.mullins_scale * scale_;
    e *= 1 - tissue_.mullins * std::erf((m.largest * m.largest - size * size) / (2 * width * width));
  }
  return e - (m.elongation < 0 ? -m.set : m.set);
}

double Row::step(const Spring& spring, const Memory& before, Memory& after, double depth) const {
  after = before;
  const double elongation = lets_go_ ? depth - spring.start : depth;
  const double change = elongation - before.elongation;
  after.elongation = elongation;
  for (std::size_t k = 0; k < kept_.size(); ++k) after.maxwell[k] = kept_[k] * before.maxwell[k] + gained_[k] * change;
  const double force = carried(after);
  const double bears = spring.reach > 0 && (before.touching || !tissue_.adhesion_on_retract_only) ? -spring.reach : 0;
  if (!lets_go_ || force > bears) {
    after.touching = true;
    return spring.stiffness * force;
  }
  after = before;  // free: the elongation at which it carries nothing, instant e + Σ g (kept q + gained (e − e₀)) = set
  double constant = -before.set, slope = instant_;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const double g = tissue_.prony[k].g;
    constant += g * (kept_[k] * before.maxwell[k] - gained_[k] * before.elongation);
    slope += g * gained_[k];
  }
  after.touching = false;
  after.elongation = -constant / slope;
  for (std::size_t k = 0; k < kept_.size(); ++k)
    after.maxwell[k] = kept_[k] * before.maxwell[k] + gained_[k] * (after.elongation - before.elongation);
  return 0;
}

double Row::trial(double depth, double dt) const {
  prepare(dt);
  double force = 0;
  Memory after;
  for (std::size_t i = 0; i < springs_.size(); ++i) force += step(springs_[i], memory_[i], after, depth);
  return force;
}

double Row::advance(double depth, double dt) {
  prepare(dt);
  double force = 0;
  Memory after;
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    force += step(springs_[i], memory_[i], after, depth);
    std::swap(memory_[i], after);
  }
  return force;
}

}  // namespace palpate::loop
