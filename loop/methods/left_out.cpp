// Runs left out in turn.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/left_out.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <loop/methods/parallel.hpp>

namespace palpate::loop {

namespace {

/// Whitened squares of one run that was not fitted.
double chi2_of_run(const Problem& p, std::size_t index, const Model& model) {
  Eigen::MatrixXd r = p.forward->measured(p.runs[index]) - p.forward->predicted(p.runs[index], model);
  p.whiteners[index].whiten(r);
  return r.squaredNorm();
}

}  // namespace

double jackknife_ratio(const std::vector<double>& estimates) {
  const double n = static_cast<double>(estimates.size()), mean = std::accumulate(estimates.begin(), estimates.end(), 0.0) / n;
  double squares = 0;
  for (double e : estimates) squares += (e - mean) * (e - mean);
  return std::abs(mean) / std::max(std::sqrt((n - 1) / n * squares), 1e-300);
}

LeftOut left_out(const Problem& p, const Model& model, int threads) {
  const Set& set = p.forward->set();
  std::vector<int> fitted_runs;
  for (std::size_t i = 0; i < p.runs.size(); ++i)
    if (set.runs[p.runs[i]].role == Role::fit) fitted_runs.push_back(static_cast<int>(i));
  if (fitted_runs.size() < 2) return {std::numeric_limits<double>::quiet_NaN(), 0};
  std::vector<double> excess(fitted_runs.size()), amplitude(fitted_runs.size(), 0.0);
  Model at_all = model;
  const Eigen::MatrixXd T = whitened(p, p.whiteners, tangents(p, at_all));  // of the fit to all runs, where each fold begins
  std::vector<int> begin = {0};
  for (std::size_t run : p.runs) begin.push_back(begin.back() + p.forward->blocks(run));
  for_each_index(static_cast<int>(fitted_runs.size()), threads, [&](int k) {
    const int i = fitted_runs[k];
    Problem without = p;
    without.runs.erase(without.runs.begin() + i);
    without.whiteners.erase(without.whiteners.begin() + i);
    Eigen::MatrixXd its_T(T.rows() - (begin[i + 1] - begin[i]), T.cols());
    its_T << T.topRows(begin[i]), T.bottomRows(T.rows() - begin[i + 1]);
    const Model fold = fitted(without, model, {&its_T}).model;
    excess[k] = chi2_of_run(p, i, fold) - p.forward->blocks(p.runs[i]);
    if (!fold.active.empty()) amplitude[k] = fold.active.back().amplitude;
  });
  return {std::accumulate(excess.begin(), excess.end(), 0.0), jackknife_ratio(amplitude)};
}

double left_out_excess(const Problem& p, const Model& model, int threads) { return left_out(p, model, threads).excess; }

}  // namespace palpate::loop
