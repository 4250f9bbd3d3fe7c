// Forward search over the catalogue.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <palpate/errors.hpp>
#include <palpate/nearest.hpp>
#include <loop/methods/alternatives.hpp>
#include <loop/methods/left_out.hpp>
#include <loop/methods/misfit.hpp>
#include <loop/methods/parallel.hpp>
#include <loop/methods/refit.hpp>
#include <loop/methods/relevance.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

using Eigen::MatrixXd, Eigen::VectorXd;

std::string kind_name(VerdictKind kind) {
  static const char* names[] = {"claimed", "confounded", "unexplained", "nothing_supported", "ranking_only"};
  return names[static_cast<int>(kind)];
}

namespace {

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

/// Whether any candidate brings the misfit down to `enough`.
bool can_reach(Session& s, const Fit& current, const Linear& l, const std::vector<Candidate>& candidates, double enough) {
  for (int c : worth_refitting(l, candidates, current.chi2 - enough))
    if (candidates[c].pruned.empty() && !is_active(current.model, candidates[c].effect) && best_refit(s, current.model, candidates[c], l, l.scores.best[c], enough).chi2 <= enough) return true;
  return false;
}

NullDistribution nulls(Session& s, const Linear& l, const std::vector<Candidate>& candidates, int count, std::uint64_t seed) {
  NullProblem null{&s.problem, &l.T, &l.S, &candidates, &l.columns, &s.shapes, &s.group, s.noise};
  return null_distribution(null, count, seed, s.threads);
}

/// Share by which the leave-one-run-out excess falls. Where noise is so wide that there is hardly any excess, the gain on runs left out is
/// held against the gain on the curves fitted, `lambda`.
double fall_of(double before, double after, double lambda) { return (before - after) / std::max({before, lambda, 1e-300}); }

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

/// An effect that hangs on one run, as a place pressed once, cannot be told from that run's own gain but by how far the other runs' gains scatter: their variance is integrated out, and the place was
/// chosen among several. Whether it is excluded that it is not there.
bool beyond_one_run(const Session& s, const Fit& current, const Tried& t, const Candidate& candidate) {
  const double places = std::max<double>(candidate.grid.size(), 1);
  return 0.5 * (misfit(s, current) - misfit(s, t.fit, current.model.active.size())) > thresholds::alternative + std::log(places);
}

constexpr const char* not_lowered = "does not lower the error in force";
constexpr const char* too_small = "changes the forces by less than the form of the effect before it is known to";

/// What speaks against a refitted candidate before runs are left out; empty: nothing. `least`: gain that a further effect must bring.
std::string against(const Session& s, const Fit& current, const Tried& t, int rows, double least, double threshold_p, bool can_claim) {
  const Active& own = t.fit.model.active.back();
  if (can_claim && !(t.p < threshold_p)) return "p above the threshold of this protocol";
  if (t.lambda < least) return "explains too little of what is still missed";
  if (at_the_edge(t.fit)) return "its amplitude runs to the edge of what is plausible";
  if (own.effect->lateral && std::abs(own.amplitude) < 2 * thresholds::prior_lateral_sd) return "no more than how a tool is set up by hand";
  if (!own.effect->lateral && whitened_change_by_last(s, t.fit.model, rows) < thresholds::visible) return "too small to change any force beyond noise";
  if (!matters(s, t.fit.model, false)) return "changes the forces by less than repeatability and curves are known to";
  if (!current.model.active.empty() && !matters(s, t.fit.model, true)) return too_small;
  if (!lowers_error(s, t.fit.model)) return not_lowered;
  if (made_up(s, current.model, t.fit.model)) return "one kind of test does not carry it: it would change other tests beyond all proportion";
  return "";
}

/// The best candidate that passes threshold and relevance; −1: none. Writes the reasons. A further effect may fail to predict runs left out where two runs alone determine it and each
/// has its own gain; it is relevant too where its amplitude hardly depends on which run is left out. Of a first step that none passes, the best whose gain
/// is found on runs left out but is no fifth of the excess: one of two effects that hide each other; the search must bear it out.
int chosen(Session& s, Fit& current, const Linear& l, const std::vector<Candidate>& candidates, std::vector<Tried>& tried, const NullDistribution* null) {
  const bool can_claim = null;
  const double threshold_p = null ? null->threshold_p : 0;
  const bool further = !current.model.active.empty();
  const double least = further ? thresholds::relevance * excess(s, current.chi2) : 0, apart = can_claim && further ? misfit(s, current) : 0;
  const double most_of_forms = can_claim && further ? largest_form_error(s, current.model) : 0;
  double before = std::numeric_limits<double>::quiet_NaN();
  int taken = -1, half = -1;
  for (int i = 0; i < static_cast<int>(tried.size()); ++i) {
    Tried& t = tried[i];
    if (!t.refitted) continue;
    if (can_claim && further && t.p < threshold_p && t.lambda < most_of_forms) t.p = std::max(t.p, null->p(t.candidate, std::max(apart - misfit(s, t.fit, current.model.active.size()), 0.0)));
    if (const std::string reason = against(s, current, t, static_cast<int>(l.S.data.rows()), least, threshold_p, can_claim); !reason.empty()) {
      t.reason = reason;
      t.unproven = further && (reason == not_lowered || reason == too_small);
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
      if (can_claim && !beyond_one_run(s, current, t, candidates[t.candidate])) {
        t.reason = "one run shows it, no more than gains of single runs do: repeat that run";
        t.unproven = further;
        continue;
      }
    } else {
      const LeftOut after = left_out(s.problem, t.fit.model, s.threads);
      t.left_out_fall = fall_of(before, after.excess, t.lambda * (1 - share_of_rows(l, l.scores.best[t.candidate], lengths_of(s))));
      const bool carried = can_claim && !current.model.active.empty() && after.amplitude_over_sd >= thresholds::carried;
      if (!(t.left_out_fall >= thresholds::relevance) && !carried) {
        t.reason = "runs left out are not predicted better";
        t.unproven = further;
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

Finding search(Session& s, int null_sets, std::uint64_t seed, const std::function<void(const std::string&)>& remark, int most_effects, double enough) {
  Finding f;
  f.candidates = candidates_of(*s.set);
  f.blind_spots = blind_spots(s, f.candidates);
  f.final = s.null;
  const bool can_claim = s.noise.replicate_degrees > 0;
  NullDistribution null, first;
  for (int step = 0;; ++step) {
    remark("step " + std::to_string(step + 1) + ": scores" + (can_claim ? " and nulls" : ""));
    const Linear l = linear(s, f.final.model, f.candidates);
    if (step + 1 == most_effects && std::isfinite(enough) && !can_reach(s, f.final, l, f.candidates, enough)) {
      f.kind = VerdictKind::unexplained;
      return f;
    }
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
    const int taken = chosen(s, f.final, l, f.candidates, f.steps.back(), can_claim ? &null : nullptr);
    if (taken < 0) break;
    f.final = f.steps.back()[taken].fit;
    if (can_claim) {
      choose_shapes_again(s, f.final, f.candidates);
      f.final = renew_noise(s, f.final.model);
    }
    if (can_claim) delete_needless(s, f.final, f.candidates, first);
  }
  if (can_claim && !f.final.model.active.empty()) bear_out(s, f);
  simplify(s, f);
  remark("alternatives");
  if (!f.final.model.active.empty()) exchange(s, f);
  if (can_claim && !f.final.model.active.empty()) add_unproven(s, f, null.threshold_p);
  f.kind = judged(f, can_claim);
  f.oddities = oddities(s, f.final.model);
  if (can_claim && !f.oddities.empty()) f.kind = VerdictKind::unexplained;
  if (one_kind_of_test(*s.set) && !f.final.model.active.empty()) f.remarks.push_back("one kind of test tells little of a law in the other tests");
  f.reported_before = with_equal_weights(s, s.null.model);
  f.reported_after = with_equal_weights(s, f.final.model);
  return f;
}

}  // namespace palpate::loop
