// Scores by projection, and the threshold by bootstrap with noise estimated anew in every draw.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/score.hpp>

#include <algorithm>
#include <cmath>

#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

using Eigen::MatrixXd, Eigen::VectorXd;

double structure(const VectorXd& r, const std::vector<int>& lengths) {
  constexpr int stretch = 6;
  double sum = 0;
  int at = 0;
  for (int length : lengths) {
    for (int b = 0; b < length; b += stretch) {
      const int n = std::min(stretch, length - b);
      sum += std::pow(r.segment(at + b, n).sum(), 2) / n;
    }
    at += length;
  }
  return sum;
}

Scores score(const MatrixXd& T, const MatrixXd& S, const VectorXd& r, const std::vector<Candidate>& candidates, const std::vector<Column>& columns,
             const std::vector<int>& lengths) {
  Scores out;
  MatrixXd scaled = T;
  for (int j = 0; j < T.cols(); ++j) scaled.col(j) /= std::max(T.col(j).norm(), 1e-300);
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(scaled);
  const MatrixXd Q = MatrixXd(qr.householderQ() * MatrixXd::Identity(T.rows(), std::max<Eigen::Index>(qr.rank(), 1)));
  const VectorXd left = r - Q * (Q.transpose() * r);
  out.directions = S - Q * (Q.transpose() * S);
  out.structure = structure(left, lengths);
  out.lambda.assign(candidates.size(), 0);
  out.best.assign(candidates.size(), -1);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const double norm = out.directions.col(j).norm(), before = S.col(j).norm();
    const bool seen = norm > 1e-6 * before && norm > 1e-12;  // else it is a sum of what is fitted already
    out.norm.push_back(seen ? norm : 0);
    out.directions.col(j) *= seen ? 1 / norm : 0;
    const double z = out.directions.col(j).dot(left);
    out.z.push_back(z);
    const int c = columns[j].candidate;
    if (seen && (z > 0 || candidates[c].is_signed()) && z * z > out.lambda[c]) {
      out.lambda[c] = z * z;
      out.best[c] = static_cast<int>(j);
    }
  }
  return out;
}

double NullDistribution::p(int candidate, double value) const {
  const auto& sorted = lambda[candidate];
  const int n = static_cast<int>(sorted.size()), tail = n / 20;
  const double corner = sorted[n - 1 - tail];
  if (value <= corner || tail < 5 || !(corner > 0)) {
    const auto at_least = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), value);
    return std::max<double>(at_least, value > corner ? 1 : at_least) / n;
  }
  double mean = 0;
  for (int i = n - tail; i < n; ++i) mean += std::log(sorted[i] / corner) / tail;
  return static_cast<double>(tail) / n * std::pow(value / corner, -1 / std::max(mean, 1e-6));
}

namespace {

struct Draw {
  std::vector<double> lambda;
  double structure;
};

Draw draw_null(const NullProblem& null, const std::vector<Whitener>& truth, const std::vector<int>& lengths, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Stacked e{VectorXd(null.T->data.rows()), VectorXd(null.T->rows.rows())};
  for (int i = 0; i < e.data.rows(); ++i) e.data(i, 0) = normal(random);
  for (int i = 0; i < e.rows.rows(); ++i) e.rows(i, 0) = normal(random);
  std::vector<VectorXd> of_run;
  int at = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    truth[i].colour(e.data.middleRows(at, lengths[i]));
    of_run.push_back(e.data.col(0).segment(at, lengths[i]));
    at += lengths[i];
  }
  const Noise noise = estimate_noise(*null.shapes, of_run, *null.group, null.noise.sensor_sd);
  std::vector<Whitener> whiteners;
  for (const NoiseShape& shape : *null.shapes) whiteners.emplace_back(shape, noise);
  const Scores s = score(whitened(*null.problem, whiteners, *null.T), whitened(*null.problem, whiteners, *null.S),
                         whitened(*null.problem, whiteners, e), *null.candidates, *null.columns, lengths);
  return {s.lambda, s.structure};
}

}  // namespace

NullDistribution null_distribution(const NullProblem& null, int draws, std::uint64_t seed) {
  std::vector<Whitener> truth;
  std::vector<int> lengths;
  for (const NoiseShape& shape : *null.shapes) {
    NoiseShape drawn = shape;
    drawn.corner.setZero();  // the same in every replicate: an error, not a draw
    truth.emplace_back(drawn, null.noise);
    lengths.push_back(static_cast<int>(shape.Q.rows()));
  }
  std::mt19937_64 random(seed);
  std::vector<Draw> all;
  for (int d = 0; d < draws; ++d) all.push_back(draw_null(null, truth, lengths, random));
  NullDistribution out;
  const std::size_t count = null.candidates->size();
  for (std::size_t c = 0; c < count; ++c) {
    std::vector<double> values;
    for (const Draw& d : all) values.push_back(d.lambda[c]);
    std::sort(values.begin(), values.end());
    out.lambda.push_back(std::move(values));
  }
  std::vector<double> smallest, structures;
  for (const Draw& d : all) {
    double p = 1;
    for (std::size_t c = 0; c < count; ++c)
      if ((*null.candidates)[c].pruned.empty()) p = std::min(p, out.p(static_cast<int>(c), d.lambda[c]));
    smallest.push_back(p);
    structures.push_back(d.structure);
  }
  std::sort(smallest.begin(), smallest.end());
  std::sort(structures.begin(), structures.end());
  out.threshold_p = smallest[static_cast<std::size_t>(thresholds::level * draws)];
  out.structure_limit = structures[static_cast<std::size_t>((1 - thresholds::level) * draws)];
  return out;
}

}  // namespace palpate::loop
