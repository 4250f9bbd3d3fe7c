// Candidates' columns scored, and the best of them fitted jointly with everything else.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/refit.hpp>

#include <algorithm>
#include <cmath>

#include <loop/methods/relevance.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

using Eigen::MatrixXd, Eigen::VectorXd;

std::vector<int> lengths_of(const Session& s) {
  std::vector<int> lengths;
  for (std::size_t run : s.problem.runs) lengths.push_back(s.forward->blocks(run));
  return lengths;
}

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

namespace {

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

}  // namespace

Fit best_refit(const Session& s, const Model& model, const Candidate& c, const Linear& l, int best, double hopeless) {
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

std::vector<int> worth_refitting(const Linear& l, const std::vector<Candidate>& candidates, double least) {
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

}  // namespace palpate::loop
