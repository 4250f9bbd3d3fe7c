// What whitening takes out from block to block: a solved curve's own scatter is correlated, a sensor's noise is not.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <loop/methods/noise.hpp>

namespace palpate::loop {
namespace {

/// Of three blocks the middle one is off by its deviation: what the last one gets of that, whitened, is −ρ/√(1 − ρ²).
double share_of_the_block_before(double sensor_sd, double curve_sd, double own) {
  NoiseShape shape;
  shape.Q = Eigen::MatrixXd::Zero(3, noise_directions);
  shape.scale = Eigen::VectorXd::Zero(noise_directions);
  shape.samples = Eigen::VectorXd::Ones(3);
  shape.corner = Eigen::VectorXd::Zero(3);
  shape.curve = Eigen::VectorXd::Constant(3, curve_sd);
  shape.curve_correlation = 0.6;
  Noise noise;
  noise.sensor_sd = sensor_sd;
  noise.correlation = own;
  const Whitener whitener(shape, noise);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(3, 1);
  x(1, 0) = std::hypot(sensor_sd, curve_sd);
  Eigen::MatrixXd there = x;
  whitener.whiten(there);
  Eigen::MatrixXd back = there;
  whitener.colour(back);
  EXPECT_NEAR((back - x).norm(), 0, 1e-12);
  return there(2, 0);
}

double share(double rho) { return -rho / std::sqrt(1 - rho * rho); }

}  // namespace

TEST(Noise, OnlyTheCurvesOwnScatterIsCorrelatedLikeIt) {
  EXPECT_NEAR(share_of_the_block_before(0.1, 0, 0), 0, 1e-12);
  EXPECT_NEAR(share_of_the_block_before(1e-9, 0.1, 0), share(0.6), 1e-9);
  EXPECT_NEAR(share_of_the_block_before(0.1, 0.1, 0), share(0.3), 1e-12);  // half of the variance is the curve's
  EXPECT_NEAR(share_of_the_block_before(0.1, 0, 0.4), share(0.4), 1e-12);  // what replicates show is of all
}

}  // namespace palpate::loop
