// What else explains it: one effect in place of several, one in place of another.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/alternatives.hpp>

#include <algorithm>
#include <cmath>

#include <loop/methods/parallel.hpp>
#include <loop/methods/refit.hpp>
#include <loop/methods/relevance.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {
namespace {

/// Each name once.
std::vector<std::string> names_of(const Model& model) {
  std::vector<std::string> names;
  for (const Active& a : model.active)
    if (std::find(names.begin(), names.end(), a.effect->entry.name) == names.end()) names.push_back(a.effect->entry.name);
  return names;
}

}  // namespace

void simplify(Finding& f) {
  if (f.final.model.active.size() < 2) return;
  const Tried* best = nullptr;
  for (const Tried& t : f.steps.front())
    if (t.refitted && !(t.p > f.threshold_p) && !at_the_edge(t.fit) && t.fit.chi2 < f.final.chi2 + 2 * thresholds::alternative && (!best || t.fit.chi2 < best->fit.chi2)) best = &t;
  if (best) f.final = best->fit;
}

void exchange(Session& s, Finding& f) {
  std::vector<std::pair<double, std::vector<std::string>>> sets = {{0, names_of(f.final.model)}};
  for (std::size_t i = 0; i < f.final.model.active.size(); ++i) {
    Model without = f.final.model;
    const Active own = without.active[i];
    without.active.erase(without.active.begin() + i);
    Fit base = fitted(s.problem, without);
    const Linear l = linear(s, base.model, f.candidates);
    const auto worth = worth_refitting(l, f.candidates, base.chi2 - f.final.chi2);
    std::vector<Fit> fits(worth.size());
    const double now = f.final.chi2;
    for_each_index(static_cast<int>(worth.size()), s.threads, [&](int k) {
      const Candidate& other = f.candidates[worth[k]];
      const double form = std::pow(other.effect->accuracy, 2) * (base.chi2 - now);
      if (other.effect != own.effect) fits[k] = best_refit(s, base.model, other, l, l.scores.best[worth[k]], now + 2 * thresholds::alternative + form);
    });
    for (std::size_t k = 0; k < worth.size(); ++k) {
      if (f.candidates[worth[k]].effect == own.effect) continue;
      Fit& fit = fits[k];
      const double form = 0.5 * std::pow(f.candidates[worth[k]].effect->accuracy, 2) * std::max(base.chi2 - fit.chi2, 0.0);
      const double behind = std::max(0.5 * (fit.chi2 - f.final.chi2) - form, std::min(0.5 * (fit.chi2 - f.final.chi2), 0.0));
      if (behind > thresholds::alternative || at_the_edge(fit) || made_up(s, base.model, fit.model) || !matters(s, fit.model)) continue;
      auto names = names_of(fit.model);
      if (std::none_of(sets.begin(), sets.end(), [&](const auto& set) { return set.second == names; })) sets.push_back({behind, std::move(names)});
      if (behind < -0.05) {
        const double shift = behind;
        f.final = std::move(fit);
        for (auto& set : sets) set.first -= shift;
      }
    }
  }
  std::stable_sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [behind, names] : sets)
    if (behind <= thresholds::alternative) {
      f.alternatives.push_back(names);
      f.alternative_distance.push_back(behind);
    }
}

}  // namespace palpate::loop
