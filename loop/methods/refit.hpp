// The linear picture around a model, and refits of single candidates beside it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>

#include <loop/methods/score.hpp>
#include <loop/methods/session.hpp>

namespace palpate::loop {

/// Blocks of each run of the session's problem.
std::vector<int> lengths_of(const Session& session);

/// The linear picture around a model.
struct Linear {
  Stacked T, S;
  Eigen::MatrixXd whitened_S;
  Scores scores;
  std::vector<Column> columns;
  double chi2 = 0;
};

bool is_active(const Model& model, const Effect* effect);

Linear linear(Session& session, Model& model, const std::vector<Candidate>& candidates);

/// The refit of the best column of a candidate; where shapes are kinds that a fit cannot move (laws, places), the best of the five best columns, one within
/// its plausible range before any at its edge. One that cannot come below `hopeless` is given up early.
Fit best_refit(const Session& session, const Model& model, const Candidate& candidate, const Linear& linear, int best,
               double hopeless = std::numeric_limits<double>::infinity());

/// Which candidates are refitted: the best by score, every instrument, and whatever looks like the best; none whose score is far below
/// `least`.
std::vector<int> worth_refitting(const Linear& linear, const std::vector<Candidate>& candidates, double least = 0);

}  // namespace palpate::loop
