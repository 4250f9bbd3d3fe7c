// Works of three states at a time.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/energy_balance.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <solver/implicit/keep.hpp>

namespace palpate::implicit {

EnergyBalance::EnergyBalance(const Assembly& assembly, const State& rest) : last_{rest.time, assembly.conjugates(rest, {})} {}

EnergyBalance::Works EnergyBalance::between(const Moment& a, const Moment& b) {
  Works works;
  for (int c = 0; c < channel_count; ++c)
    works[c] = 0.5 * (a.channels[c].force + b.channels[c].force).dot(b.channels[c].place - a.channels[c].place);
  return works;
}

void EnergyBalance::take(const Assembly& assembly, const State& state, const Equations& equations) {
  last_ = {state.time, assembly.conjugates(state, equations)};
  stored_ = equations.stored;
  in_slips_ = assembly.stored_in_slips(state);
  tissue_remembers_ = equations.tissue.size() > 0;
}

double EnergyBalance::stored_sum() const { return stored_.layers + stored_.springs + stored_.contact + (tissue_remembers_ ? 0 : stored_.tissue); }

EnergyBalance::Works EnergyBalance::works() const {
  Works works;
  for (int c = 0; c < channel_count; ++c) works[c] = trapezoid_[c] + correction_[c];
  return works;
}

/// What is brought less what is taken.
double EnergyBalance::balance(const Works& works) const {
  return std::accumulate(works.begin(), works.begin() + bringing_channels, 0.0) - std::accumulate(works.begin() + bringing_channels, works.end(), 0.0);
}

double EnergyBalance::imbalance() const { return balance(works()) - stored_sum() + remeshing_ - jumps_; }

double EnergyBalance::correction() const { return balance(correction_); }

double EnergyBalance::worst_imbalance() const { return largest_ > 0 ? worst_ / largest_ : 0; }

void EnergyBalance::add(const Assembly& assembly, const Accepted& found) {
  const double missing = imbalance();
  const Moment first = std::move(before_), middle = std::move(last_);
  take(assembly, found.state, found.equations);
  const Works step = between(middle, last_);
  for (int c = 0; c < channel_count; ++c) trapezoid_[c] += step[c];
  if (before_known_) {
    const Works half = between(first, middle), whole = between(first, last_);
    const double h1 = std::pow(middle.time - first.time, 3), h2 = std::pow(last_.time - middle.time, 3);
    const double rest = std::pow(last_.time - first.time, 3) - h1 - h2;
    for (int c = 0; c < channel_count; ++c) correction_[c] += (half[c] + step[c] - whole[c]) * (corrected_ ? h2 : h1 + h2) / rest;
  }
  corrected_ = before_known_;
  before_ = middle;
  before_known_ = true;
  if (found.by_drag) {
    jumps_ += imbalance() - missing;
    before_known_ = corrected_ = false;
  }
  worst_ = std::max(worst_, std::abs(imbalance()));
  const Works all = works();
  for (double work : all) largest_ = std::max(largest_, std::abs(work));
  largest_ = std::max(largest_, std::abs(stored_sum()));
}

double EnergyBalance::remeshed(const Assembly& assembly, const State& state, const Equations& equations) {
  const double before = stored_sum(), slips = in_slips_;
  take(assembly, state, equations);
  before_known_ = corrected_ = false;
  const double slipped = in_slips_ - slips, change = stored_sum() - before + slipped;
  remeshing_ += change;
  trapezoid_[static_cast<int>(Channel::friction)] += slipped;  // what is lost stays
  return change;
}

void EnergyBalance::keep(Archive& archive) {
  for (Moment* moment : {&last_, &before_}) {
    archive(moment->time);
    for (auto& pairs : moment->channels) archive(pairs.force, pairs.place);
  }
  archive(before_known_, corrected_, trapezoid_, correction_, stored_, in_slips_, jumps_, remeshing_, worst_, largest_, tissue_remembers_);
}

}  // namespace palpate::implicit
