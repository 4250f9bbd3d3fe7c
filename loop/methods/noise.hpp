// Noise of a run: Σ = D ½ R D ½ + Q diag(v) Qᵀ: sensor and fast scatter with correlation ρ from block to block, and run-to-run changes of
// gain, of contact and of slow drift (cosines of time, in four bands of frequency), with Q their orthonormal directions in that order.
// The variances come from differences between replicates, never from a misfit.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/forward/model.hpp>

#include <random>

namespace palpate::loop {

/// First direction of each band that shares one variance: gain, contact, drift of order 0 to 1, 2 to 4, 5 to 9, 10 to 17; then the end.
inline constexpr int noise_bands[] = {0, 1, 2, 4, 7, 12, 20};
inline constexpr int noise_directions = 20;

/// What a run's noise looks like, whatever its size.
struct NoiseShape {
  Eigen::MatrixXd Q;       ///< blocks × directions, orthonormal
  Eigen::VectorXd scale;   ///< of each direction: N per unit of its relative standard deviation
  Eigen::VectorXd samples; ///< in each block
  Eigen::VectorXd corner;  ///< what a block's mean may be off where the force turns between two samples, N
  Eigen::VectorXd curve;   ///< fast scatter that a solved curve has of its own, N
  double curve_correlation = 0;  ///< of that, from block to block
  double largest_N = 1;
};

struct Noise {
  double sensor_sd = 0;   ///< of one sample, N
  double scatter = 0;     ///< further fast scatter of a block, relative to the run's largest force
  double correlation = 0; ///< of fast scatter from block to block
  std::vector<double> sd = std::vector<double>(noise_directions, 0.0);  ///< relative, of each direction
  int replicate_degrees = 0;  ///< runs in groups minus groups; 0: nothing is known of run-to-run changes
};

/// Σ^(-½) and Σ^(½) of one run. Rows of the matrices are blocks.
class Whitener {
 public:
  Whitener(const NoiseShape& shape, const Noise& noise);
  void whiten(Eigen::Ref<Eigen::MatrixXd> x) const;
  void colour(Eigen::Ref<Eigen::MatrixXd> z) const;
  double variance() const { return variance_; }  ///< mean over the blocks
  /// The fast part alone: divides by the blocks' deviation and takes the correlation out.
  void whiten_fast(Eigen::Ref<Eigen::MatrixXd> x) const;

 private:
  Eigen::VectorXd sd_, rho_;
  double variance_;
  Eigen::MatrixXd U_;
  Eigen::VectorXd shrink_, grow_;
};

/// Directions of the run's noise at a model that predicts `predicted` (N) with dF/du `slope` (N/mm) in each block. The direction of gain is what was measured without its
/// fast noise: predicted, and the difference from it averaged over neighbours. With the noise in it a fit sinks by the gain's variance for every block (Peelle 1987;
/// D'Agostini 1994, Nucl. Instr. Meth. A 346:306).
NoiseShape noise_shape(const Forward& forward, std::size_t run, const Eigen::VectorXd& predicted, const Eigen::VectorXd& slope, double depth_scale_mm);

/// `residual[i]` belongs to `shapes[i]`; `group[i]` names its replicates, −1 for none.
Noise estimate_noise(const std::vector<NoiseShape>& shapes, const std::vector<Eigen::VectorXd>& residual, const std::vector<int>& group,
                     double sensor_sd);

}  // namespace palpate::loop
