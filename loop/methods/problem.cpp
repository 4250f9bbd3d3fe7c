// Residuals, tangents by differences, damped Gauss–Newton.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/problem.hpp>

#include <cmath>

namespace palpate::loop {

using Eigen::MatrixXd, Eigen::VectorXd;

namespace {

int blocks_of(const Problem& p) {
  int count = 0;
  for (std::size_t run : p.runs) count += p.forward->blocks(run);
  return count;
}

/// f of all runs.
VectorXd predicted(const Problem& p, const Model& model) {
  VectorXd f(blocks_of(p));
  int at = 0;
  for (std::size_t run : p.runs) {
    const int n = p.forward->blocks(run);
    f.segment(at, n) = p.forward->predicted(run, model);
    at += n;
  }
  return f;
}

double series_compliance(const Model& model) {
  double c = model.compliance_mm_per_N;
  for (const Active& a : model.active)
    if (a.effect->compliance) c += a.effect->compliance(a.amplitude);
  return c;
}

std::array<double, 2> lateral(const Model& model, const Run& run) {
  std::array<double, 2> sum = {0, 0};
  for (const Active& a : model.active)
    if (a.effect->lateral) {
      const auto own = a.effect->lateral(run, a.amplitude, a.shape);
      sum = {sum[0] + own[0], sum[1] + own[1]};
    }
  return sum;
}

/// Rows behind the data: priors, the block, lateral forces. Values are (observed − modelled)/sd.
std::vector<double> further_rows(const Problem& p, const Model& model, const std::vector<FitParameter>& parameters) {
  std::vector<double> rows;
  for (const FitParameter& q : parameters)
    if (q.prior_sd > 0) rows.push_back((q.prior - *q.value) / q.prior_sd);
  if (p.block_compliance_sd > 0) rows.push_back((p.block_compliance - series_compliance(model)) / p.block_compliance_sd);
  for (const Lateral& l : p.laterals) {
    const auto modelled = lateral(model, p.forward->set().runs[l.run]);
    rows.push_back((l.x - modelled[0]) / l.sd);
    rows.push_back((l.y - modelled[1]) / l.sd);
  }
  return rows;
}

VectorXd vector_of(const std::vector<double>& values) { return Eigen::Map<const VectorXd>(values.data(), values.size()); }

}  // namespace

MatrixXd whitened(const Problem& p, const std::vector<Whitener>& whiteners, const Stacked& columns) {
  MatrixXd all(columns.data.rows() + columns.rows.rows(), columns.data.cols());
  all << columns.data, columns.rows;
  int at = 0;
  for (std::size_t i = 0; i < p.runs.size(); ++i) {
    const int n = p.forward->blocks(p.runs[i]);
    whiteners[i].whiten(all.middleRows(at, n));
    at += n;
  }
  return all;
}

Stacked residual(const Problem& p, Model& model) {
  VectorXd y(blocks_of(p));
  int at = 0;
  for (std::size_t run : p.runs) {
    const int n = p.forward->blocks(run);
    y.segment(at, n) = p.forward->measured(run);
    at += n;
  }
  return {y - predicted(p, model), vector_of(further_rows(p, model, fit_parameters(model, p.forward->set())))};
}

Stacked tangents(const Problem& p, Model& model) {
  auto parameters = fit_parameters(model, p.forward->set());
  const VectorXd f = predicted(p, model);
  const VectorXd rows = vector_of(further_rows(p, model, parameters));
  Stacked T{MatrixXd(f.size(), parameters.size()), MatrixXd(rows.size(), parameters.size())};
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    FitParameter& q = parameters[j];
    const double value = *q.value, x = q.coordinate();
    q.set_coordinate(x + q.step);
    if (std::abs(q.coordinate() - x) < 0.5 * q.step) q.set_coordinate(x - q.step);  // at its upper bound
    const double moved = q.coordinate() - x;
    T.data.col(j) = (predicted(p, model) - f) / moved;
    T.rows.col(j) = (rows - vector_of(further_rows(p, model, parameters))) / moved;
    *q.value = value;
  }
  return T;
}

Stacked secant(const Problem& p, Model& model, const Effect& effect, double amplitude, const std::vector<double>& shape) {
  Model with = model;
  with.active.push_back({&effect, amplitude, shape});
  const VectorXd rows = vector_of(further_rows(p, model, fit_parameters(model, p.forward->set())));
  const VectorXd rows_with = vector_of(further_rows(p, with, fit_parameters(with, p.forward->set())));
  return {(predicted(p, with) - predicted(p, model)) / amplitude, (rows - rows_with) / amplitude};
}

namespace {

/// The gradient without what a bound stops; N loses those rows and columns.
VectorXd held(VectorXd g, const std::vector<FitParameter>& parameters, MatrixXd& N) {
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    if (!parameters[j].is_stopped(g(j))) continue;
    const double own = N(j, j);
    N.row(j).setZero();
    N.col(j).setZero();
    N(j, j) = own;
    g(j) = 0;
  }
  return g;
}

/// The step of a damped system; what would leave its bounds goes to them, and the others' step knows it.
VectorXd bounded_step(const MatrixXd& N, const VectorXd& g, const std::vector<FitParameter>& parameters) {
  const int n = static_cast<int>(g.size());
  VectorXd step = N.ldlt().solve(g), fixed = VectorXd::Zero(n);
  std::vector<bool> stopped(n, false);
  const auto coordinate = [](const FitParameter& p, double value) { return p.logarithmic ? std::log(std::max(value, 1e-300)) : value; };
  for (int pass = 0; pass < 4; ++pass) {
    bool more = false;
    for (int j = 0; j < n; ++j) {
      const FitParameter& p = parameters[j];
      const double down = coordinate(p, p.low) - p.coordinate(), up = coordinate(p, p.high) - p.coordinate();
      if (stopped[j] || (step(j) >= down && step(j) <= up)) continue;
      fixed(j) = step(j) < down ? down : up;
      stopped[j] = more = true;
    }
    if (!more) break;
    MatrixXd M = N;
    VectorXd b = g - N * fixed;
    for (int j = 0; j < n; ++j) {
      if (!stopped[j]) continue;
      M.row(j).setZero();
      M.col(j).setZero();
      M(j, j) = 1;
      b(j) = fixed(j);
    }
    step = M.ldlt().solve(b);
  }
  return step;
}

}  // namespace

Fit fitted(const Problem& p, Model start, const FitHelp& help) {
  Fit fit{std::move(start), 0, {}, false};
  VectorXd r = whitened(p, p.whiteners, residual(p, fit.model));
  fit.chi2 = r.squaredNorm();
  double damping = 1e-3;
  MatrixXd T, N;
  bool fresh = help.tangents;  // tangents are kept while steps do what they promise
  if (fresh) T = *help.tangents;
  for (int iteration = 0; iteration < 25 && !fit.converged; ++iteration) {
    const bool kept = fresh;
    if (!kept) T = whitened(p, p.whiteners, tangents(p, fit.model));
    N = T.transpose() * T;
    const VectorXd g = held(T.transpose() * r, fit_parameters(fit.model, p.forward->set()), N);
    const MatrixXd some = N + 1e-9 * MatrixXd((N.diagonal().array() + 1e-12).matrix().asDiagonal());
    if (!kept && fit.chi2 - 4 * g.dot(some.ldlt().solve(g)) > help.hopeless_above) break;
    for (int attempt = 0; attempt < 8; ++attempt) {
      MatrixXd damped = N;
      damped.diagonal() += damping * (N.diagonal().array() + 1e-12).matrix();
      Model trial = fit.model;
      auto parameters = fit_parameters(trial, p.forward->set());
      const VectorXd step = bounded_step(damped, g, parameters);
      for (std::size_t j = 0; j < parameters.size(); ++j) {
        const double most = parameters[j].logarithmic ? 1.5 : 1e300;
        parameters[j].set_coordinate(parameters[j].coordinate() + std::clamp(step(j), -most, most));
      }
      const VectorXd r_trial = whitened(p, p.whiteners, residual(p, trial));
      const double chi2 = r_trial.squaredNorm();
      if (chi2 < fit.chi2) {
        fit.converged = fit.chi2 - chi2 < 1e-4 * std::max(1.0, 1e-3 * chi2) && damping < 1;  // a step that damping made small says nothing
        fresh = !fit.converged && fit.chi2 - chi2 > 0.9 * (2 * g.dot(step) - step.dot(N * step));
        fit.model = trial;
        fit.chi2 = chi2;
        r = r_trial;
        damping = std::max(damping * 0.2, 1e-9);
        break;
      }
      damping *= 6;
      if (attempt == 7) fit.converged = !kept;
      fresh = false;
    }
  }
  fit.covariance = (N + 1e-12 * MatrixXd(N.diagonal().asDiagonal()) + 1e-300 * MatrixXd::Identity(N.rows(), N.cols())).inverse();
  return fit;
}

}  // namespace palpate::loop
