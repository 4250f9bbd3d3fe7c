// What else explains it: one effect in place of several, one in place of another.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/alternatives.hpp>

#include <algorithm>
#include <cmath>

#include <loop/methods/misfit.hpp>
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

/// Whether both name the same, in whatever order.
bool same(std::vector<std::string> a, std::vector<std::string> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

void add(Finding& f, const std::vector<std::string>& names, double behind) {
  if (std::any_of(f.alternatives.begin(), f.alternatives.end(), [&](const auto& other) { return same(other, names); })) return;
  f.alternatives.push_back(names);
  f.alternative_distance.push_back(behind);
}

}  // namespace

void simplify(Session& s, Finding& f) {
  if (f.final.model.active.size() < 2) return;
  constexpr std::size_t asked = 3;  // by the weights of the first step, which are not those of the last
  std::vector<const Tried*> singles;
  for (const Tried& t : f.steps.front())
    if (t.refitted && !(t.p > f.threshold_p) && !at_the_edge(t.fit)) singles.push_back(&t);
  std::sort(singles.begin(), singles.end(), [](const Tried* a, const Tried* b) { return a->fit.chi2 < b->fit.chi2; });
  singles.resize(std::min(singles.size(), asked));
  Fit best;
  best.chi2 = f.final.chi2 + 2 * thresholds::alternative;
  for (const Tried* t : singles)
    if (Fit fit = fitted(s.problem, t->fit.model); fit.chi2 < best.chi2) best = std::move(fit);
  if (best.model.active.empty()) return;
  f.final = std::move(best);
}

void choose_shapes_again(Session& s, Fit& current, const std::vector<Candidate>& candidates) {
  if (current.model.active.size() < 2) return;
  for (std::size_t i = 0; i < current.model.active.size(); ++i) {
    const Active own = current.model.active[i];
    const auto c = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) { return candidate.effect == own.effect; });
    if (own.effect->refines || own.effect->repeats || c->grid.size() < 2) continue;
    for (const auto& shape : c->grid) {
      if (shape == own.shape) continue;
      Model other = current.model;
      other.active[i].shape = shape;
      if (Fit fit = fitted(s.problem, other); fit.chi2 < current.chi2 - 2 * thresholds::alternative) current = std::move(fit);
    }
  }
}

void exchange(Session& s, Finding& f) {
  std::vector<std::pair<double, std::vector<std::string>>> sets = {{0, names_of(f.final.model)}};
  double best = misfit(s, f.final);
  int restarts = 0;
  for (std::size_t i = 0; i < f.final.model.active.size(); ++i) {
    bool better = false;
    Model without = f.final.model;
    const Active own = without.active[i];
    without.active.erase(without.active.begin() + i);
    Fit base = fitted(s.problem, without);
    const Linear l = linear(s, base.model, f.candidates);
    const auto worth = worth_refitting(l, f.candidates, base.chi2 - f.final.chi2);
    std::vector<Fit> fits(worth.size());
    std::vector<double> hopeless(worth.size());
    const double now = f.final.chi2;
    for_each_index(static_cast<int>(worth.size()), s.threads, [&](int k) {
      const Candidate& other = f.candidates[worth[k]];
      const int column = l.scores.best[worth[k]];
      const double change = l.scores.z[column] / std::max(l.scores.norm[column], 1e-300) * l.whitened_S.col(column).norm();  // of the forces, before anything is fitted to it
      hopeless[k] = now + thresholds::hopeless_apart + std::pow(other.effect->accuracy * change, 2);
      if (other.effect == own.effect) return;
      fits[k] = best_refit(s, base.model, other, l, column, hopeless[k]);
    });
    for (std::size_t k = 0; k < worth.size(); ++k) {
      if (f.candidates[worth[k]].effect == own.effect) continue;
      Fit& fit = fits[k];
      double behind = 0.5 * (fit.chi2 - f.final.chi2);
      if (fit.chi2 > hopeless[k] || at_the_edge(fit) || made_up(s, base.model, fit.model) || !matters(s, fit.model, false)) continue;
      if (behind < 0 && !matters(s, fit.model, !base.model.active.empty())) behind = 0;  // as good, and too small to be claimed
      if (behind > 0) behind = std::max(0.5 * (misfit(s, fit) - best), 0.0);
      if (behind > thresholds::alternative) continue;
      auto names = names_of(fit.model);
      if (std::none_of(sets.begin(), sets.end(), [&](const auto& set) { return same(set.second, names); })) sets.push_back({behind, std::move(names)});
      if (behind < -0.05) {
        const double shift = behind;
        f.final = std::move(fit);
        best = misfit(s, f.final);
        for (auto& set : sets) set.first -= shift;
        better = true;
      }
    }
    if (better && restarts++ < thresholds::most_effects) i = static_cast<std::size_t>(-1);  // the other effects are exchanged beside the better one
  }
  std::stable_sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [behind, names] : sets)
    if (behind <= thresholds::alternative) add(f, names, behind);
}

void add_unproven(Session& s, Finding& f, double threshold_p) {
  std::vector<std::pair<double, const Tried*>> open;
  const auto beside = [&](const Model& model) {  // the finding as it is now
    Model without = model;
    without.active.pop_back();
    return same(names_of(without), names_of(f.final.model));
  };
  for (const Tried& t : f.steps.back())
    if (t.unproven && t.p < threshold_p && beside(t.fit.model)) open.push_back({0.5 * misfit(s, t.fit), &t});
  std::sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [misfit, tried] : open)
    if (misfit <= open.front().first + thresholds::alternative) add(f, names_of(tried->fit.model), 0);
}

}  // namespace palpate::loop
