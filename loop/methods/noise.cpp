// Variances from replicates; whitening and colouring with a few directions (Woodbury) and a first-order correlation.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/noise.hpp>

#include <algorithm>
#include <cmath>

#include <loop/methods/thresholds.hpp>
#include <loop/set/thinned.hpp>

namespace palpate::loop {

using Eigen::MatrixXd, Eigen::VectorXd, Eigen::VectorXi;

namespace {

double prior_sd(int direction) {
  return direction == 0 ? thresholds::prior_gain_sd : direction == 1 ? thresholds::prior_offset_sd : thresholds::prior_drift_sd / (direction - 1);
}

/// Blocks become independent: x_b − ρ_b x_{b−1}.
void decorrelate(const VectorXd& rho, Eigen::Ref<MatrixXd> x) {
  for (Eigen::Index b = x.rows() - 1; b > 0; --b)
    if (rho(b) != 0) x.row(b) = (x.row(b) - rho(b) * x.row(b - 1)) / std::sqrt(1 - rho(b) * rho(b));
}
void correlate(const VectorXd& rho, Eigen::Ref<MatrixXd> x) {
  for (Eigen::Index b = 1; b < x.rows(); ++b)
    if (rho(b) != 0) x.row(b) = std::sqrt(1 - rho(b) * rho(b)) * x.row(b) + rho(b) * x.row(b - 1);
}

/// What each block shares with the one before: a solved curve's own scatter does, a sensor's does not, so the share is that of the curve in the two
/// (antedependence of order one: Gabriel 1962, Ann. Math. Stat. 33:201).
VectorXd correlations(const NoiseShape& shape, const Noise& noise, const VectorXd& sd) {
  VectorXd rho = VectorXd::Constant(sd.size(), noise.correlation);
  for (Eigen::Index b = 1; b < sd.size(); ++b) rho(b) = std::max(rho(b), shape.curve_correlation * shape.curve(b) * shape.curve(b - 1) / (sd(b) * sd(b - 1)));
  return rho;
}

}  // namespace

Whitener::Whitener(const NoiseShape& shape, const Noise& noise) {
  const double scatter = noise.scatter * shape.largest_N;
  sd_ = (noise.sensor_sd * noise.sensor_sd * shape.samples.cwiseInverse().array() + scatter * scatter + shape.corner.array().square() + shape.curve.array().square()).sqrt();
  rho_ = correlations(shape, noise, sd_);
  MatrixXd Z = shape.Q;
  for (int j = 0; j < Z.cols(); ++j) Z.col(j) *= noise.sd[j] * shape.scale(j);
  variance_ = (sd_.squaredNorm() + Z.squaredNorm()) / sd_.size();
  Z.array().colwise() /= sd_.array();
  decorrelate(rho_, Z);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(Z.transpose() * Z);  // Z = U S Vᵀ
  U_ = Z * eigen.eigenvectors();
  shrink_ = grow_ = VectorXd::Zero(Z.cols());
  for (int j = 0; j < Z.cols(); ++j) {
    const double s2 = std::max(eigen.eigenvalues()(j), 0.0);
    if (!(s2 > 1e-14)) {
      U_.col(j).setZero();
      continue;
    }
    U_.col(j) /= std::sqrt(s2);
    shrink_(j) = 1 - 1 / std::sqrt(1 + s2);
    grow_(j) = std::sqrt(1 + s2) - 1;
  }
}

void Whitener::whiten_fast(Eigen::Ref<MatrixXd> x) const {
  x.array().colwise() /= sd_.array();
  decorrelate(rho_, x);
}

void Whitener::whiten(Eigen::Ref<MatrixXd> x) const {
  whiten_fast(x);
  x -= U_ * (shrink_.asDiagonal() * (U_.transpose() * x)).eval();
}

void Whitener::colour(Eigen::Ref<MatrixXd> z) const {
  z += U_ * (grow_.asDiagonal() * (U_.transpose() * z)).eval();
  correlate(rho_, z);
  z.array().colwise() *= sd_.array();
}

namespace {

/// Largest second difference of a block, less what noise makes of it (four deviations), over the block's samples.
VectorXd corners(const Forward& forward, std::size_t run) {
  const auto& force = forward.set().runs[run].F;
  const VectorXi count = forward.rows_per_block(run);
  const double noise = 4 * std::sqrt(6.0) * fast_sd(force);
  VectorXd corner = VectorXd::Zero(count.size());
  std::size_t i = 0;
  for (int b = 0; b < count.size(); ++b) {
    double largest = 0;
    for (int k = 0; k < count(b); ++k, ++i)
      if (i > 0 && i + 1 < force.size()) largest = std::max(largest, std::abs(force[i + 1] - 2 * force[i] + force[i - 1]));
    corner(b) = thresholds::corner * std::max(0.0, largest - noise) / count(b);
  }
  return corner;
}

/// Means over seven neighbours on either side, none beyond the phase.
VectorXd smoothed(const Forward& forward, std::size_t run, const VectorXd& x) {
  constexpr int reach = 7;
  const int n = static_cast<int>(x.size());
  VectorXd mean(n);
  for (int b = 0; b < n; ++b) {
    int low = b, high = b;
    while (low > 0 && b - low < reach && forward.phase_of(run, low - 1) == forward.phase_of(run, b)) --low;
    while (high + 1 < n && high - b < reach && forward.phase_of(run, high + 1) == forward.phase_of(run, b)) ++high;
    mean(b) = x.segment(low, high - low + 1).mean();
  }
  return mean;
}

}  // namespace

NoiseShape noise_shape(const Forward& forward, std::size_t run, const VectorXd& predicted, const VectorXd& slope, double depth_scale_mm) {
  NoiseShape shape;
  const VectorXd F = forward.measured(run), t = forward.times(run);
  const int n = static_cast<int>(F.size());
  shape.samples = forward.samples_per_block(run);
  shape.corner = corners(forward, run);
  shape.curve = forward.curve_scatter(run);
  shape.curve_correlation = forward.set().clamp_correlation;
  shape.largest_N = std::max(F.cwiseAbs().maxCoeff(), 1e-12);
  MatrixXd B(n, noise_directions);
  B.col(0) = predicted + smoothed(forward, run, F - predicted);
  B.col(1) = slope * depth_scale_mm;
  const VectorXd x = (t.array() - t(0)) / std::max(t(n - 1) - t(0), 1e-12);
  for (int j = 2; j < noise_directions; ++j) B.col(j) = shape.largest_N * ((j - 2) * M_PI * x.array()).cos();
  shape.Q = MatrixXd::Zero(n, noise_directions);
  shape.scale = VectorXd::Zero(noise_directions);
  for (int j = 0; j < std::min(n / 3, noise_directions); ++j) {  // Gram–Schmidt, twice
    VectorXd q = B.col(j);
    const double before = q.norm();
    for (int again = 0; again < 2; ++again)
      for (int k = 0; k < j; ++k) q -= shape.Q.col(k).dot(q) * shape.Q.col(k);
    if (!(q.norm() > 1e-6 * before)) continue;
    shape.scale(j) = q.norm();
    shape.Q.col(j) = q / q.norm();
  }
  return shape;
}

namespace {

struct Sums {
  std::vector<double> square = std::vector<double>(noise_directions, 0.0);
  double degrees = 0, left = 0, expected = 0, neighbours = 0, weight = 0;
};

/// Deviations of one group's runs from their mean.
void add_group(const std::vector<const NoiseShape*>& shapes, const std::vector<const VectorXd*>& residual, double sensor_sd, Sums& sums) {
  const int m = static_cast<int>(shapes.size());
  int n = static_cast<int>(residual[0]->size());
  for (const VectorXd* r : residual) n = std::min(n, static_cast<int>(r->size()));
  VectorXd mean = VectorXd::Zero(n);
  for (const VectorXd* r : residual) mean += r->head(n) / m;
  sums.degrees += m - 1;
  for (int i = 0; i < m; ++i) {
    const NoiseShape& s = *shapes[i];
    VectorXd d = residual[i]->head(n) - mean;
    for (int j = 0; j < noise_directions; ++j) {
      if (!(s.scale(j) > 0)) continue;
      const double c = s.Q.col(j).head(n).dot(d);
      sums.square[j] += std::pow(c / s.scale(j), 2);
      d -= c * s.Q.col(j).head(n);
    }
    d /= s.largest_N;
    int quiet = 0;  // blocks without a corner: the others say nothing about scatter
    for (int b = 0; b < n; ++b) {
      if (s.corner(b) > 0) d(b) = 0;
      quiet += s.corner(b) == 0;
    }
    const double freedom = std::max(1.0, (quiet - noise_directions) * (1.0 - 1.0 / m));
    sums.left += d.squaredNorm();
    sums.weight += freedom;
    sums.expected += sensor_sd * sensor_sd / (s.largest_N * s.largest_N) / s.samples.mean() * freedom;
    sums.neighbours += d.head(n - 1).dot(d.tail(n - 1));
  }
}

}  // namespace

Noise estimate_noise(const std::vector<NoiseShape>& shapes, const std::vector<VectorXd>& residual, const std::vector<int>& group, double sensor_sd) {
  Sums sums;
  const int groups = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
  for (int g = 0; g < groups; ++g) {
    std::vector<const NoiseShape*> its_shapes;
    std::vector<const VectorXd*> its_residual;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      if (group[i] == g) {
        its_shapes.push_back(&shapes[i]);
        its_residual.push_back(&residual[i]);
      }
    if (its_shapes.size() > 1) add_group(its_shapes, its_residual, sensor_sd, sums);
  }
  Noise noise;
  noise.sensor_sd = sensor_sd;
  noise.replicate_degrees = static_cast<int>(sums.degrees);
  const double w = thresholds::prior_weight;
  for (std::size_t band = 0; band + 1 < std::size(noise_bands); ++band) {
    const int first = noise_bands[band], end = noise_bands[band + 1];
    double square = 0;
    for (int j = first; j < end; ++j) square += sums.square[j];
    const double prior = prior_sd(first), degrees = sums.degrees * (end - first);
    for (int j = first; j < end; ++j) noise.sd[j] = std::sqrt((square + w * prior * prior) / (degrees + w));
  }
  if (sums.weight > 0) {
    noise.scatter = std::sqrt(std::max(0.0, (sums.left - sums.expected) / sums.weight));
    noise.correlation = std::clamp(sums.neighbours / std::max(sums.left, 1e-300), 0.0, 0.9);
  }
  return noise;
}

}  // namespace palpate::loop
