// How much an effect hangs on one run.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <loop/methods/left_out.hpp>

using namespace palpate::loop;

/// Of a mean the jackknife's deviation is the usual one, s/√n.
TEST(LeftOut, JackknifeOfAMeanIsItsStandardError) {
  const std::vector<double> x = {1.0, 1.4, 0.7, 1.2, 0.9};
  double sum = 0, square = 0;
  for (double v : x) sum += v;
  const double mean = sum / 5;
  std::vector<double> without;
  for (double v : x) {
    without.push_back((sum - v) / 4);
    square += (v - mean) * (v - mean);
  }
  EXPECT_NEAR(jackknife_ratio(without), mean / std::sqrt(square / 4 / 5), 1e-9);
}

/// What one run alone makes of nothing is no more than its own deviation.
TEST(LeftOut, AnEffectOfOneRunIsNotCarried) {
  std::vector<double> without(15, 0.3);
  without[4] = 0;  // it goes with the run
  EXPECT_LT(jackknife_ratio(without), 1.1);
}
