// The layer's factors against the exact solution that the solver is verified with, and against Hertz and Garcia.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <loop/forward/backbone.hpp>
#include <loop/forward/layer.hpp>
#include <tests/verify/bonded_layer.hpp>

using namespace palpate::loop;

TEST(Layer, BallAgreesWithTheVerifiedSolution) {
  for (double chi : {0.1, 0.25, 0.354, 0.5, 0.8})
    EXPECT_TRUE(std::abs(layer_factor(false, true, 0.5, chi) / palpate::verify::ball_on_layer_factor(chi) - 1) <= 1e-3) << chi;
}

TEST(Layer, PunchAgreesWithTheVerifiedSolution) {
  for (double ratio : {0.2, 0.6, 1.1})
    EXPECT_TRUE(std::abs(layer_factor(true, true, 0.5, ratio) / palpate::verify::punch_on_layer_factor(ratio) - 1) <= 1e-3) << ratio;
}

TEST(Layer, SlidesAndCompressesMoreEasily) {
  const double bonded = layer_factor(false, true, 0.5, 0.5), sliding = layer_factor(false, false, 0.5, 0.5), soft = layer_factor(false, true, 0.4, 0.5);
  EXPECT_LT(sliding, bonded);
  EXPECT_LT(soft, bonded);
  EXPECT_GT(sliding, 1);
}

/// For thick layers the factor is 1 + (2/π) a₀ χ + ((2/π) a₀ χ)², a₀ = ∫₀^∞ (1 − M) dα = 1.1684 for a layer on a smooth base
/// (Vorovich, Aleksandrov and Babeshko 1974). Dimitriadis' series has 0.884 χ in its place.
TEST(Layer, SlidingBaseBeginsAsItsIntegralSays) {
  const double chi = 0.05, first = 2 / M_PI * 1.1684 * chi;
  EXPECT_TRUE(std::abs((layer_factor(false, false, 0.5, chi) - 1 - first * first) / first - 1) <= 0.01);
}

TEST(Backbone, NeoHookeAndFungFollowLin2009) {
  Site site{{"ball", 5.0}, {0, 0, 0}, 1e6, true};
  Tissue tissue;
  tissue.law = &law_named("neo_hookean");
  tissue.parameters = {0.01};
  const double R = 5, delta = 2, a = std::sqrt(R * delta), x = a / R;
  const double hertz = 16.0 / 3 * 0.01 * a * delta;
  const double lin = (x * x - 15 * x + 75) / 75 * 125 / (5 * x * x - 50 * x + 125);
  EXPECT_TRUE(std::abs(elastic_force(site, tissue, delta) / (hertz * lin) - 1) <= 1e-5);
  tissue.law = &law_named("fung_demiray");
  tissue.parameters = {0.01, 2.0};
  const double exponent = 2.0 * (x * x * x - 15 * x * x) / (25 * x - 125);
  EXPECT_TRUE(std::abs(elastic_force(site, tissue, delta) / (hertz * lin * std::exp(exponent)) - 1) <= 1e-5);
}
