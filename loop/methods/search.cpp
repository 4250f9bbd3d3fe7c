// Forward search over the catalogue.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <palpate/errors.hpp>
#include <palpate/nearest.hpp>
#include <loop/methods/parallel.hpp>
#include <loop/methods/relevance.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

using Eigen::MatrixXd, Eigen::VectorXd;

std::string kind_name(VerdictKind kind) {
  static const char* names[] = {"claimed", "confounded", "unexplained", "nothing_supported", "ranking_only"};
  return names[static_cast<int>(kind)];
}

namespace {

std::vector<int> lengths_of(const Session& s) {
  std::vector<int> lengths;
  for (std::size_t run : s.problem.runs) lengths.push_back(s.forward->blocks(run));
  return lengths;
}

/// The linear picture around a model.
struct Linear {
  Stacked T, S;
  MatrixXd whitened_S;
  Scores scores;
  std::vector<Column> columns;
  double chi2 = 0;
};

bool is_active(const Model& model, const Effect* effect) {
  return std::any_of(model.active.begin(), model.active.end(), [&](const Active& a) { return a.effect == effect && !effect->repeats; });
}

Linear linear(Session& s, Model& model, const std::vector<Candidate>& candidates) {
  Linear l;
  for (const Column& c : columns_of(candidates))
    if (!is_active(model, candidates[c.candidate].effect)) l.columns.push_back(c);
  l.T = tangents(s.problem, model);
  l.S = secants(s.problem, model, candidates, l.columns);
  l.whitened_S = whitened(s.problem, s.problem.whiteners, l.S);
  const VectorXd r = whitened(s.problem, s.problem.whiteners, residual(s.problem, model));
  l.chi2 = r.squaredNorm();
  MatrixXd T = whitened(s.problem, s.problem.whiteners, l.T);
  const auto parameters = fit_parameters(model, *s.set);
  for (std::size_t j = 0; j < parameters.size(); ++j)  // what is stopped by a bound explains nothing more
    if (parameters[j].is_stopped(T.col(j).dot(r))) {
      T.col(j).setZero();
      l.T.data.col(j).setZero();
      l.T.rows.col(j).setZero();
    }
  l.scores = score(T, l.whitened_S, r, candidates, l.columns, lengths_of(s));
  return l;
}

/// A refit that cannot come below `hopeless` is given up early, but where the derivative at the start means little.
Fit refit_with(const Session& s, const Model& model, const Candidate& c, const std::vector<double>& shape, double amplitude, double hopeless) {
  const Range& range = c.effect->entry.parameters[0].range;
  Model with = model;
  with.active.push_back({c.effect, std::clamp(amplitude, range.min, range.max), shape});
  return fitted(s.problem, with, {nullptr, c.effect->probe_of ? std::numeric_limits<double>::infinity() : hopeless});
}

/// A limit just under the largest force read, on a tissue stiff enough to reach beyond it.
Fit limit_refit(const Session& s, const Model& model, const Candidate& c, const std::vector<double>& shape) {
  Model stiff = model;
  for (std::size_t i = 0; i < stiff.parameters.size(); ++i)
    if (stiff.law->parameters[i].unit == "MPa") stiff.parameters[i] *= 1.2;
  return refit_with(s, stiff, c, shape, 0.87 * c.probe, std::numeric_limits<double>::infinity());
}

/// Two starts: the score's amplitude, and the secant's for effects whose derivative at zero means little.
Fit column_refit(const Session& s, const Model& model, const Candidate& c, const Linear& l, int column, double hopeless) {
  const auto& shape = c.grid[l.columns[column].grid];
  const double e = l.scores.z[column] / l.scores.norm[column];
  Fit fit = refit_with(s, model, c, shape, e, hopeless);
  const double expected = l.scores.z[column] * l.scores.z[column];
  if (fit.chi2 <= l.chi2 - 0.8 * expected && !c.effect->probe_of) return fit;
  Fit other = c.effect->told_inverse ? limit_refit(s, model, c, shape) : refit_with(s, model, c, shape, std::copysign(c.probe, e), hopeless);
  return other.chi2 < fit.chi2 ? other : fit;
}

/// The best column's refit; where shapes are kinds that a fit cannot move (laws, places), the best of the five best columns, one within
/// its plausible range before any at its edge.
Fit best_refit(const Session& s, const Model& model, const Candidate& c, const Linear& l, int best, double hopeless = std::numeric_limits<double>::infinity()) {
  Fit fit = column_refit(s, model, c, l, best, hopeless);
  if (c.effect->refines) return fit;
  std::vector<int> others;
  for (int j = 0; j < static_cast<int>(l.columns.size()); ++j)
    if (j != best && l.columns[j].candidate == l.columns[best].candidate && l.scores.norm[j] > 0 && (l.scores.z[j] > 0 || c.is_signed())) others.push_back(j);
  std::sort(others.begin(), others.end(), [&](int a, int b) { return std::abs(l.scores.z[a]) > std::abs(l.scores.z[b]); });
  others.resize(std::min<std::size_t>(others.size(), 4));
  for (int j : others) {
    Fit other = column_refit(s, model, c, l, j, hopeless);
    const bool worse = at_the_edge(fit) || made_up(s, model, fit.model), other_worse = at_the_edge(other) || made_up(s, model, other.model);
    if (std::pair(other_worse, other.chi2) < std::pair(worse, fit.chi2)) fit = std::move(other);
  }
  return fit;
}

/// Which candidates are refitted: the best by score, every instrument, and whatever looks like the best; none whose score is far below
/// `least`.
std::vector<int> worth_refitting(const Linear& l, const std::vector<Candidate>& candidates, double least = 0) {
  std::vector<int> order;
  for (int c = 0; c < static_cast<int>(candidates.size()); ++c)
    if (l.scores.best[c] >= 0) order.push_back(c);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return l.scores.lambda[a] > l.scores.lambda[b]; });
  std::vector<int> chosen;
  for (int i = 0; i < static_cast<int>(order.size()); ++i) {
    const bool instrument = candidates[order[i]].effect->entry.kind == "instrument";
    const double cosine = std::abs(l.scores.directions.col(l.scores.best[order[i]]).dot(l.scores.directions.col(l.scores.best[order[0]])));
    if (l.scores.lambda[order[i]] < thresholds::hopeless * std::max(least, l.scores.lambda[order[0]])) continue;
    if (i < thresholds::refitted || instrument || cosine > 0.9) chosen.push_back(order[i]);
  }
  return chosen;
}

std::vector<Tried> try_all(Session& s, Fit& current, const Linear& l, const std::vector<Candidate>& candidates, const NullDistribution* null) {
  std::vector<Tried> tried;
  const auto chosen = worth_refitting(l, candidates);
  for (int c = 0; c < static_cast<int>(candidates.size()); ++c) {
    if (!candidates[c].pruned.empty() || is_active(current.model, candidates[c].effect)) continue;
    Tried t;
    t.candidate = c;
    const int column = l.scores.best[c];
    t.lambda_linear = l.scores.lambda[c];
    t.z = column >= 0 ? l.scores.z[column] : 0;
    t.reason = column >= 0 ? "little gain" : "wrong sign, or no signature of its own";
    t.refitted = std::find(chosen.begin(), chosen.end(), c) != chosen.end();
    tried.push_back(std::move(t));
  }
  for_each_index(static_cast<int>(tried.size()), s.threads, [&](int i) {
    Tried& t = tried[i];
    if (!t.refitted) return;
    t.fit = best_refit(s, current.model, candidates[t.candidate], l, l.scores.best[t.candidate]);
    t.lambda = std::max(0.0, current.chi2 - t.fit.chi2);
    if (null) t.p = null->p(t.candidate, t.lambda);
  });
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return std::pair(a.refitted, a.lambda) > std::pair(b.refitted, b.lambda); });
  return tried;
}

NullDistribution nulls(Session& s, const Linear& l, const std::vector<Candidate>& candidates, int count, std::uint64_t seed) {
  NullProblem null{&s.problem, &l.T, &l.S, &candidates, &l.columns, &s.shapes, &s.group, s.noise};
  return null_distribution(null, count, seed, s.threads);
}

/// Share by which the leave-one-run-out excess falls. Where noise is so wide that there is hardly any excess, the gain on runs left out is
/// held against the gain on the curves fitted, `lambda`.
double fall_of(const Session& s, double before, const Model& after, double lambda) {
  return (before - left_out_excess(s.problem, after, s.threads)) / std::max({before, lambda, 1e-300});
}

/// Share of what speaks for a candidate's best column that lies outside the curves: in what is known beforehand, the block run, lateral forces.
double share_of_rows(const Linear& l, int column, const std::vector<int>& lengths) {
  const int blocks = std::accumulate(lengths.begin(), lengths.end(), 0);
  return l.scores.directions.col(column).tail(l.scores.directions.rows() - blocks).squaredNorm();
}

/// The larger of that and of the share that lies in one run: leaving runs out cannot confirm it.
double share_of_one_run(const Linear& l, int column, const std::vector<int>& lengths) {
  const VectorXd direction = l.scores.directions.col(column);
  double largest = share_of_rows(l, column, lengths);
  int at = 0;
  for (int length : lengths) {
    largest = std::max(largest, direction.segment(at, length).squaredNorm());
    at += length;
  }
  return largest;
}

/// The best candidate that passes threshold and relevance; −1: none. Writes the reasons. Of a first step that none passes, the best whose gain
/// is found on runs left out but is no fifth of the excess: one of two effects that hide each other; the search must bear it out.
int chosen(Session& s, Fit& current, const Linear& l, std::vector<Tried>& tried, double threshold_p, bool can_claim) {
  double form = 0;  // what the effects taken so far may leave because their shortcuts are not exact
  for (const Active& a : current.model.active) form = std::max(form, std::pow(std::min(a.effect->accuracy, thresholds::further_matters), 2) * (s.null.chi2 - current.chi2));
  const double least = current.model.active.empty() ? 0 : std::max(thresholds::relevance * excess(s, current.chi2), form);
  double before = std::numeric_limits<double>::quiet_NaN();
  int taken = -1, half = -1;
  for (int i = 0; i < static_cast<int>(tried.size()); ++i) {
    Tried& t = tried[i];
    if (!t.refitted) continue;
    if (can_claim && !(t.p < threshold_p)) {
      t.reason = "p above the threshold of this protocol";
      continue;
    }
    if (t.lambda < least) {
      t.reason = "explains too little of what is still missed";
      continue;
    }
    if (at_the_edge(t.fit)) {
      t.reason = "its amplitude runs to the edge of what is plausible";
      continue;
    }
    const Active& own = t.fit.model.active.back();
    if (own.effect->lateral && std::abs(own.amplitude) < 2 * thresholds::prior_lateral_sd) {
      t.reason = "no more than how a tool is set up by hand";
      continue;
    }
    if (!own.effect->lateral && whitened_change_by_last(s, t.fit.model, static_cast<int>(l.S.data.rows())) < thresholds::visible) {
      t.reason = "too small to change any force beyond noise";
      continue;
    }
    if (!matters(s, t.fit.model)) {
      t.reason = "changes the forces by less than repeatability and curves are known to";
      continue;
    }
    if (made_up(s, current.model, t.fit.model)) {
      t.reason = "one kind of test does not carry it: it would change other tests beyond all proportion";
      continue;
    }
    if (taken >= 0) {
      t.reason = "fits less well than the one taken";
      continue;
    }
    if (!current.model.active.empty() && s.problem.runs.size() < 3) {
      t.reason = "too few runs to tell a further effect";
      continue;
    }
    if (!can_claim && !(t.lambda > thresholds::relevance * current.chi2 && t.lambda > 2 * thresholds::alternative)) continue;
    if (std::isnan(before)) before = left_out_excess(s.problem, current.model, s.threads);
    if (std::isnan(before) || (!can_claim && s.problem.runs.size() < 3)) {  // too few runs to leave one out
      t.left_out_fall = std::numeric_limits<double>::quiet_NaN();
    } else if (share_of_one_run(l, l.scores.best[t.candidate], lengths_of(s)) > thresholds::one_run) {
      t.left_out_fall = std::numeric_limits<double>::quiet_NaN();
    } else {
      t.left_out_fall = fall_of(s, before, t.fit.model, t.lambda * (1 - share_of_rows(l, l.scores.best[t.candidate], lengths_of(s))));
      if (!(t.left_out_fall >= thresholds::relevance)) {
        t.reason = "runs left out are not predicted better";
        if (half < 0 && can_claim && current.model.active.empty() && t.left_out_fall * before > 0.5 * t.lambda) half = i;
        continue;
      }
    }
    t.reason = "taken";
    taken = i;
  }
  if (taken < 0 && half >= 0) tried[half].reason = "taken, if a further effect bears it out";
  return taken >= 0 ? taken : half;
}

/// Each name once.
std::vector<std::string> names_of(const Model& model) {
  std::vector<std::string> names;
  for (const Active& a : model.active)
    if (std::find(names.begin(), names.end(), a.effect->entry.name) == names.end()) names.push_back(a.effect->entry.name);
  return names;
}

/// One effect that explains as well as several is the better explanation.
void simplify(Finding& f) {
  if (f.final.model.active.size() < 2) return;
  const Tried* best = nullptr;
  for (const Tried& t : f.steps.front())
    if (t.refitted && !(t.p > f.threshold_p) && !at_the_edge(t.fit) && t.fit.chi2 < f.final.chi2 + 2 * thresholds::alternative && (!best || t.fit.chi2 < best->fit.chi2)) best = &t;
  if (best) f.final = best->fit;
}

/// What was taken for now goes again unless runs left out are predicted better by a fifth in the end.
void bear_out(Session& s, Finding& f) {
  for (const Tried& t : f.steps.front())
    if (t.reason == "taken") return;
  const double before = left_out_excess(s.problem, s.null.model, s.threads), after = left_out_excess(s.problem, f.final.model, s.threads);
  if (before - after >= thresholds::relevance * before) return;
  f.final = s.null;
  f.structure_after = f.structure_before;
}

/// Effects that a later one has made needless go again. `null` is that of the model without effects.
void delete_needless(Session& s, Fit& current, const std::vector<Candidate>& candidates, const NullDistribution& null) {
  for (std::size_t i = 0; current.model.active.size() > 1 && i < current.model.active.size();) {
    Model without = current.model;
    without.active.erase(without.active.begin() + i);
    Fit fit = fitted(s.problem, without);
    int c = 0;
    while (candidates[c].effect != current.model.active[i].effect) ++c;
    const double lost = std::max(0.0, fit.chi2 - current.chi2);
    if (null.p(c, lost) < null.threshold_p && lost > thresholds::relevance * excess(s, fit.chi2)) {
      ++i;
    } else {
      current = std::move(fit);
      i = 0;
    }
  }
}

/// Every active effect is exchanged for every other; a better exchange becomes the model, near ones become alternatives.
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

VerdictKind judged(const Finding& f, bool can_claim) {
  if (!can_claim) return VerdictKind::ranking_only;
  const double expected = f.structure_limit / 1.3;  // about its mean under the null
  const bool structured = f.structure_after - expected > thresholds::structure_margin * (f.structure_limit - expected);
  const double left = (f.structure_after - expected) / std::max(f.structure_before - expected, 1e-300);
  if (f.final.model.active.empty()) return structured ? VerdictKind::unexplained : VerdictKind::nothing_supported;
  if (structured && left > thresholds::unexplained_share) return VerdictKind::unexplained;
  return f.alternatives.size() > 1 ? VerdictKind::confounded : VerdictKind::claimed;
}

}  // namespace

std::vector<BlindSpot> blind_spots(Session& s, const std::vector<Candidate>& candidates) {
  const Linear l = linear(s, s.null.model, candidates);
  std::vector<BlindSpot> spots;
  std::vector<int> strongest(candidates.size(), -1);
  for (int j = 0; j < static_cast<int>(l.columns.size()); ++j) {
    int& best = strongest[l.columns[j].candidate];
    if (best < 0 || l.scores.norm[j] > l.scores.norm[best]) best = j;
  }
  for (int c = 0; c < static_cast<int>(candidates.size()); ++c) {
    if (strongest[c] < 0) continue;
    BlindSpot spot{c, std::numeric_limits<double>::infinity(), false, {}};
    if (l.scores.norm[strongest[c]] > 0) spot.smallest_visible = thresholds::visible / l.scores.norm[strongest[c]];
    spot.visible = spot.smallest_visible <= candidates[c].largest();
    for (int other = 0; other < static_cast<int>(candidates.size()); ++other)
      if (other != c && strongest[other] >= 0 &&
          std::abs(l.scores.directions.col(strongest[c]).dot(l.scores.directions.col(strongest[other]))) > thresholds::confounded_cosine)
        spot.like.push_back(other);
    spots.push_back(spot);
  }
  return spots;
}

Fit fit_with(Session& s, const std::string& effect) {
  const auto candidates = candidates_of(*s.set);
  std::vector<std::string> names;
  for (int c = 0; c < static_cast<int>(candidates.size()); ++c) {
    names.push_back(candidates[c].effect->entry.name);
    if (names.back() != effect) continue;
    if (!candidates[c].pruned.empty()) throw Failure(ExitCode::refused, "this set cannot tell of " + effect + ": " + candidates[c].pruned, s.set->file.string());
    const Linear l = linear(s, s.null.model, candidates);
    if (l.scores.best[c] < 0) throw Failure(ExitCode::refused, effect + " has no signature of its own here, or the wrong sign", s.set->file.string());
    return best_refit(s, s.null.model, candidates[c], l, l.scores.best[c]);
  }
  throw Failure(ExitCode::misuse, "unknown effect: " + effect, "", "did you mean " + nearest_name(effect, names) + "?");
}

Finding search(Session& s, int null_sets, std::uint64_t seed, const std::function<void(const std::string&)>& remark, int most_effects) {
  Finding f;
  f.candidates = candidates_of(*s.set);
  f.blind_spots = blind_spots(s, f.candidates);
  f.final = s.null;
  const bool can_claim = s.noise.replicate_degrees > 0;
  NullDistribution null, first;
  for (int step = 0;; ++step) {
    remark("step " + std::to_string(step + 1) + ": scores" + (can_claim ? " and nulls" : ""));
    const Linear l = linear(s, f.final.model, f.candidates);
    if (can_claim) null = nulls(s, l, f.candidates, null_sets, seed + step);
    (step == 0 ? f.structure_before : f.structure_after) = l.scores.structure;
    f.structure_after = l.scores.structure;
    f.structure_limit = null.structure_limit;
    if (step == 0) {
      f.threshold_p = null.threshold_p;
      first = null;
    }
    if (step == most_effects) break;
    remark("step " + std::to_string(step + 1) + ": refits");
    f.steps.push_back(try_all(s, f.final, l, f.candidates, can_claim ? &null : nullptr));
    const int taken = chosen(s, f.final, l, f.steps.back(), null.threshold_p, can_claim);
    if (taken < 0) break;
    f.final = f.steps.back()[taken].fit;
    if (can_claim) delete_needless(s, f.final, f.candidates, first);
  }
  if (can_claim && !f.final.model.active.empty()) bear_out(s, f);
  simplify(f);
  remark("alternatives");
  if (!f.final.model.active.empty()) exchange(s, f);
  f.kind = judged(f, can_claim);
  f.oddities = oddities(s, f.final.model);
  if (can_claim && !f.oddities.empty()) f.kind = VerdictKind::unexplained;
  if (one_kind_of_test(*s.set) && !f.final.model.active.empty()) f.remarks.push_back("one kind of test tells little of a law in the other tests");
  f.reported_before = with_equal_weights(s, s.null.model);
  f.reported_after = with_equal_weights(s, f.final.model);
  return f;
}

}  // namespace palpate::loop
