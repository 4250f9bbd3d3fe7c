// Sieves: what the set declares known, what its tests cannot show, what a run in air or on a block denies.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/candidates.hpp>

#include <algorithm>
#include <cmath>

#include <loop/forward/register.hpp>

namespace palpate::loop {
namespace {

bool any(const Set& set, auto condition) {
  return std::any_of(set.runs.begin(), set.runs.end(), [&](const Run& r) { return r.role == Role::fit && condition(r); });
}

bool returns(const Run& run) {
  return std::count(run.phase.begin(), run.phase.end(), "unload") >= 3;
}

bool holds_or_returns(const Run& run) { return returns(run) || std::count(run.phase.begin(), run.phase.end(), "hold") >= 3; }

int rates(const Set& set) {
  std::vector<double> seen;
  for (const Run& run : set.runs) {
    if (run.role != Role::fit || !run.timed) continue;
    double fastest = 0;
    for (std::size_t i = 1; i < run.t.size(); ++i) fastest = std::max(fastest, std::abs(run.u[i] - run.u[i - 1]) / (run.t[i] - run.t[i - 1]));
    if (std::none_of(seen.begin(), seen.end(), [&](double v) { return std::abs(std::log(v / fastest)) < 0.4; })) seen.push_back(fastest);
  }
  return static_cast<int>(seen.size());
}

std::string sieve(const Set& set, const Effect& effect) {
  if (!effect.absent.empty()) return "absent: " + effect.absent;
  if (set.specimen.shape == "tube" ? effect.tissue && !effect.on_clamp : effect.clamp_only)
    return effect.clamp_only ? "there is no clamp" : "not solved for a clamp";
  if (effect.needs_contact && !any(set, [](const Run& r) { return r.test == Test::indentation; })) return "homogeneous tests cannot show it";
  if (effect.needs_time && !any(set, [](const Run& r) { return r.timed; })) return "the runs have no times";
  if (effect.needs_unload && !any(set, returns)) return "no run unloads";
  if (effect.needs_hold && !any(set, holds_or_returns) && rates(set) < 2) return "no hold, no unloading and one rate only";
  return effect.known ? effect.known(set) : "";
}

}  // namespace

double Candidate::largest() const {
  const Range& range = effect->entry.parameters[0].range;
  return std::max(std::abs(range.min), std::abs(range.max));
}

std::vector<Candidate> candidates_of(const Set& set) {
  std::vector<Candidate> list;
  for (const Effect& effect : all_effects()) {
    Candidate c{&effect, effect.grid_of ? effect.grid_of(set) : effect.grid, 0, sieve(set, effect)};
    if (c.pruned.empty() && c.grid.empty()) c.pruned = "one site only";
    if (effect.absent.empty()) c.probe = effect.probe_of ? effect.probe_of(set) : effect.entry.parameters[0].typical;
    list.push_back(std::move(c));
  }
  return list;
}

std::vector<Column> columns_of(const std::vector<Candidate>& candidates) {
  std::vector<Column> columns;
  for (int c = 0; c < static_cast<int>(candidates.size()); ++c)
    if (candidates[c].pruned.empty())
      for (int g = 0; g < static_cast<int>(candidates[c].grid.size()); ++g) columns.push_back({c, g});
  return columns;
}

Stacked secants(const Problem& p, Model& model, const std::vector<Candidate>& candidates, const std::vector<Column>& columns) {
  Stacked all;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const Candidate& c = candidates[columns[j].candidate];
    const Stacked s = secant(p, model, *c.effect, c.probe, c.grid[columns[j].grid]);
    if (j == 0) all = {Eigen::MatrixXd(s.data.rows(), columns.size()), Eigen::MatrixXd(s.rows.rows(), columns.size())};
    all.data.col(j) = s.data;
    all.rows.col(j) = s.rows;
  }
  return all;
}

}  // namespace palpate::loop
