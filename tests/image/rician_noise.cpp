// Rician noise: mean and variance against their closed forms (Gudbjartsson and Patz 1995).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/rician_noise.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace palpate;

namespace {

/// σ √(π/2) L(−A²/2σ²),  L(x) = e^{x/2} [(1 − x) I₀(−x/2) − x I₁(−x/2)]
double rician_mean(double a, double sigma) {
  const double x = -a * a / (2 * sigma * sigma);
  const double l = std::exp(x / 2) * ((1 - x) * std::cyl_bessel_i(0, -x / 2) - x * std::cyl_bessel_i(1, -x / 2));
  return sigma * std::sqrt(std::numbers::pi / 2) * l;
}

}  // namespace

TEST(RicianNoise, HasTheMomentsOfTheRiceDistribution) {
  constexpr int n = 400000;
  const double sigma = 50;
  for (double a : {0.0, 25.0, 100.0, 500.0}) {
    double sum = 0, squares = 0;
    for (int i = 0; i < n; ++i) {
      const double m = rician(a, sigma, 3, i);
      sum += m;
      squares += m * m;
    }
    const double mean = sum / n, five_errors = 5 * sigma / std::sqrt(double(n));  // a right generator passes but once in two million
    EXPECT_NEAR(mean, rician_mean(a, sigma), five_errors) << a;
    const double second = a * a + 2 * sigma * sigma;  // E M² is exact
    EXPECT_NEAR(squares / n, second, 5 * std::sqrt(4 * sigma * sigma * (a * a + sigma * sigma) / n)) << a;
  }
}

TEST(RicianNoise, IsTheSameForTheSameVoxelAndSeed) {
  EXPECT_EQ(rician(100, 5, 1, 42), rician(100, 5, 1, 42));
  EXPECT_NE(rician(100, 5, 1, 42), rician(100, 5, 2, 42));
  EXPECT_NE(rician(100, 5, 1, 42), rician(100, 5, 1, 43));
  EXPECT_EQ(rician(100, 0, 1, 42), 100);
}
