// Form errors as columns of a ridge regression, and the noise's variances integrated out.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/misfit.hpp>

#include <algorithm>
#include <cmath>

#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

using Eigen::MatrixXd, Eigen::VectorXd;

double marginal_squares(double squares, int count, double degrees) { return (degrees + count) * std::log1p(squares / degrees); }

namespace {

constexpr int orders = 3;

/// Whether an effect's change depends on depth alone, not on how the tool came there.
bool of_depth_alone(const Effect& effect) { return effect.entry.kind == "material" || effect.entry.kind == "start" || effect.entry.kind == "layer" || effect.entry.kind == "force"; }

/// Where in the set's range of displacements, −1 to 1, each block of a run is.
VectorXd places(const Session& s, std::size_t run, double low, double high) {
  VectorXd x = s.forward->averaged(run, s.set->runs[run].u);
  for (double& at : x) at = 2 * std::clamp((at - low) / std::max(high - low, 1e-300), 0.0, 1.0) - 1;
  return x;
}

}  // namespace

MatrixXd form_errors(const Session& s, const Model& model, std::size_t effects) {
  const std::size_t count = std::min(effects, model.active.size());
  std::vector<std::string> tools;
  Eigen::Index rows = 0;
  double low = 1e300, high = -1e300;
  for (std::size_t run : s.problem.runs) {
    const Run& r = s.set->runs[run];
    if (std::find(tools.begin(), tools.end(), r.tool) == tools.end()) tools.push_back(r.tool);
    rows += s.forward->blocks(run);
    low = r.test == Test::indentation ? 0 : std::min(low, *std::min_element(r.u.begin(), r.u.end()));
    high = std::max(high, *std::max_element(r.u.begin(), r.u.end()));
  }
  const Eigen::Index per_source = 2 * static_cast<Eigen::Index>(tools.size()) * orders;
  std::vector<std::pair<std::size_t, std::size_t>> together;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      if (model.active[a].effect->tissue && model.active[b].effect->tissue) together.push_back({a, b});
  MatrixXd all = MatrixXd::Zero(rows, per_source * static_cast<Eigen::Index>(count + together.size()));
  Eigen::Index at = 0;
  for (std::size_t run : s.problem.runs) {
    const Run& r = s.set->runs[run];
    const int n = s.forward->blocks(run), tool = static_cast<int>(std::find(tools.begin(), tools.end(), r.tool) - tools.begin());
    const VectorXd x = places(s, run, low, high), with = s.forward->predicted(run, model);
    VectorXd out(n);
    for (int b = 0; b < n; ++b) {
      const std::string phase = s.forward->phase_of(run, b);
      out(b) = phase == "unload" || phase == "rest";
    }
    const double least = 0.02 * std::max(with.cwiseAbs().maxCoeff(), 1e-300);  // below it a change relative to the force means little
    Eigen::Index source = 0;
    const auto add = [&](const VectorXd& change, bool depth_alone) {
      for (int b = 0; b < n; ++b) {
        const Eigen::Index first = source * per_source + (2 * tool + (!depth_alone && out(b) > 0)) * orders;
        all(at + b, first) = change(b);
        all(at + b, first + 1) = change(b) * x(b);
        all(at + b, first + 2) = change(b) * (1.5 * x(b) * x(b) - 0.5);
      }
      ++source;
    };
    std::vector<VectorXd> changes;
    for (std::size_t a = 0; a < count; ++a) {
      Model without = model;
      without.active.erase(without.active.begin() + static_cast<long>(a));
      changes.push_back(with - s.forward->predicted(run, without));
      const Effect& effect = *model.active[a].effect;
      add(effect.accuracy * changes.back(), of_depth_alone(effect));
    }
    for (const auto& [a, b] : together)
      add((changes[a].array() * changes[b].array() / with.cwiseAbs().cwiseMax(least).array()).matrix(), of_depth_alone(*model.active[a].effect) && of_depth_alone(*model.active[b].effect));
    at += n;
  }
  return all;
}

double largest_form_error(const Session& s, const Model& model) {
  constexpr double deviations = 3;
  const MatrixXd forms = form_errors(s, model, model.active.size());
  return deviations * deviations * whitened(s.problem, s.problem.whiteners, {forms, MatrixXd(0, forms.cols())}).squaredNorm();
}

namespace {

/// Whitened squares of what is left, each band of noise with its variance integrated out.
double squares_of(const Session& s, const VectorXd& left) {
  double rest = left.squaredNorm(), marginal = 0;
  std::vector<double> squares(std::size(noise_bands) - 1, 0.0);
  std::vector<int> count(squares.size(), 0);
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < s.problem.runs.size(); ++i) {
    const NoiseShape& shape = s.shapes[i];
    const Eigen::Index n = shape.Q.rows();
    MatrixXd slow = shape.Q;
    for (int j = 0; j < noise_directions; ++j) slow.col(j) *= s.noise.sd[j] * shape.scale(j);
    s.problem.whiteners[i].whiten(slow);
    std::vector<int> bands;
    MatrixXd directions(n, noise_directions);
    for (std::size_t band = 0; band < squares.size(); ++band)
      for (int j = noise_bands[band]; j < noise_bands[band + 1]; ++j)
        if (slow.col(j).squaredNorm() > 0.5) {  // where fast noise is the larger part, how large it is is known from many samples
          directions.col(static_cast<Eigen::Index>(bands.size())) = slow.col(j);
          bands.push_back(static_cast<int>(band));
        }
    const Eigen::Index used = static_cast<Eigen::Index>(bands.size());
    if (used > 0) {
      const Eigen::HouseholderQR<MatrixXd> qr(directions.leftCols(used));
      const VectorXd along = (qr.householderQ() * MatrixXd::Identity(n, used)).transpose() * left.segment(at, n);
      for (Eigen::Index j = 0; j < used; ++j) {
        squares[bands[j]] += along(j) * along(j);
        ++count[bands[j]];
      }
    }
    at += n;
  }
  for (std::size_t band = 0; band < squares.size(); ++band) {
    rest -= squares[band];
    marginal += marginal_squares(squares[band], count[band], s.noise.replicate_degrees * (noise_bands[band + 1] - noise_bands[band]) + thresholds::prior_weight);
  }
  return rest + marginal;
}

}  // namespace

double misfit(const Session& s, const Fit& fit, std::size_t effects) {
  Model model = fit.model;
  VectorXd left = whitened(s.problem, s.problem.whiteners, residual(s.problem, model));
  double own_squares = 0;
  const MatrixXd forms = form_errors(s, model, effects);
  if (forms.cols() > 0) {
    const Stacked T = tangents(s.problem, model);
    MatrixXd free = whitened(s.problem, s.problem.whiteners, T);
    const auto parameters = fit_parameters(model, *s.set);
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      const double norm = free.col(j).norm();
      if (parameters[j].is_stopped(free.col(j).dot(left)) || !(norm > 0)) free.col(j).setZero();
      else free.col(j) /= norm;
    }
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(free);
    const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(free.rows(), std::max<Eigen::Index>(qr.rank(), 1));
    MatrixXd own = whitened(s.problem, s.problem.whiteners, {forms, MatrixXd::Zero(T.rows.rows(), forms.cols())});
    own -= Q * (Q.transpose() * own);
    const VectorXd size = (MatrixXd::Identity(own.cols(), own.cols()) + own.transpose() * own).ldlt().solve(own.transpose() * left);
    left -= own * size;
    own_squares = size.squaredNorm();
  }
  return own_squares + (s.noise.replicate_degrees > 0 ? squares_of(s, left) : left.squaredNorm());
}

}  // namespace palpate::loop
