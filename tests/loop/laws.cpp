// Homogeneous tests of every law: closed forms, and P = dW/du by another route.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <loop/forward/laws.hpp>

using namespace palpate::loop;
using Mode = palpate::loop::Test;

TEST(Laws, ClosedForms) {
  const std::vector<double> mr = {0.2, 0.1}, nh = {0.3};
  for (double l : {0.7, 1.2, 2.5}) {
    EXPECT_NEAR(nominal_stress(Mode::uniaxial, l, law_named("mooney_rivlin"), mr, {}), 2 * (l - 1 / (l * l)) * (0.2 + 0.1 / l), 1e-12);
    EXPECT_NEAR(nominal_stress(Mode::equibiaxial, l, law_named("mooney_rivlin"), mr, {}), 2 * (l - std::pow(l, -5)) * (0.2 + 0.1 * l * l), 1e-12);
    EXPECT_NEAR(nominal_stress(Mode::pure_shear, l, law_named("neo_hookean"), nh, {}), 0.3 * (l - std::pow(l, -3)), 1e-12);
  }
  for (double g : {-0.4, 0.1, 1.5}) EXPECT_NEAR(nominal_stress(Mode::simple_shear, g, law_named("mooney_rivlin"), mr, {}), 2 * 0.3 * g, 1e-12);
}

/// Every stiffening keeps the initial modulus and vanishes with its amplitude.
TEST(Laws, StiffeningKeepsTheInitialModulus) {
  const std::vector<double> p = {0.01};
  const Stiffening kinds[] = {{3, 0, 0, 0, 0}, {0, 0.5, 0, 0, 0}, {0, 0, 2, 0, 0}, {0, 0, 0, 2, 0}, {0, 0, 0, 0, 4}};
  for (const Stiffening& s : kinds) {
    const double small = 1e-5, plain = nominal_stress(Mode::uniaxial, 1 + small, law_named("neo_hookean"), p, {});
    EXPECT_TRUE(std::abs(nominal_stress(Mode::uniaxial, 1 + small, law_named("neo_hookean"), p, s) / plain - 1) <= 1e-4);
    EXPECT_GT(std::abs(nominal_stress(Mode::uniaxial, 1.5, law_named("neo_hookean"), p, s) / nominal_stress(Mode::uniaxial, 1.5, law_named("neo_hookean"), p, {}) - 1), 0.02);
  }
}

/// Ogden's energy differentiated numerically along the test.
TEST(Laws, OgdenIsTheDerivativeOfItsEnergy) {
  const double mu = 0.02, alpha = -3.5;
  const auto W = [&](double l) { return 2 * mu / (alpha * alpha) * (std::pow(l, alpha) + 2 * std::pow(l, -alpha / 2) - 3); };
  const std::vector<double> p = {mu, alpha};
  const double h = 1e-6;
  EXPECT_NEAR(nominal_stress(Mode::uniaxial, 1.4, law_named("ogden"), p, {}), (W(1.4 + h) - W(1.4 - h)) / (2 * h), 1e-9);
}
