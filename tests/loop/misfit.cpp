// What is not known about noise and forms, counted when explanations are compared.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <loop/methods/misfit.hpp>
#include <tests/loop/pressed_layer.hpp>

namespace palpate::loop {
/// Of a Gaussian's variance known to ν degrees the integral over what it may be.
TEST(Misfit, MarginalSquaresAreTheIntegralOverTheVariance) {
  constexpr double degrees = 6;
  constexpr int count = 15;
  const auto minus_two_log = [&](double squares) {
    double sum = 0;
    for (double log_variance = -8; log_variance < 8; log_variance += 1e-3) {
      const double v = std::exp(log_variance);  // scaled inverse chi-square about 1, per log v
      sum += std::pow(v, -0.5 * (degrees + count)) * std::exp(-0.5 * (degrees + squares) / v);
    }
    return -2 * std::log(sum);
  };
  for (double squares : {1.0, 15.0, 60.0, 300.0})
    EXPECT_NEAR(marginal_squares(squares, count, degrees) - marginal_squares(15, count, degrees), minus_two_log(squares) - minus_two_log(15), 1e-6) << squares;
  EXPECT_NEAR(marginal_squares(30, count, 1e9), 30, 1e-4);
}

/// A change whose form is off by as much as its accuracy allows is no misfit; one that is off by much more is.
TEST(Misfit, AFormMayBeOffByItsAccuracy) {
  const Model truth = tissue_with("friction", 0.2, {0});
  const auto left = [&](double bend, std::size_t effects) {
    const Set set = measured(truth, quiet, bend);
    const Session session = prepared(set);
    const Fit fit = fitted(session.problem, truth);
    return misfit(session, fit, effects);
  };
  const double exact = left(0, 1);
  const double bend = named("friction")->accuracy;
  EXPECT_GT(left(bend, 0), exact + 30) << "the case tests nothing: the elastic curve's own error hides it";
  EXPECT_LT(left(bend, 1), exact + 12);
  EXPECT_GT(left(12 * bend, 1), exact + 30);
}

/// Two effects may interact as much as the product of what each changes, and one alone has nothing to interact with.
TEST(Misfit, InterplayIsTheProductOfTwoChanges) {
  Model model = tissue_with("prony", 0.1, {5});
  model.active.push_back({named("support"), 0.2, {0}});
  const Set set = measured(model, quiet);
  const Session session = prepared(set);
  const Eigen::MatrixXd both = form_errors(session, model, 2), first = form_errors(session, model, 1);
  ASSERT_EQ(both.cols(), 3 * first.cols());
  Model no_prony = model, no_support = model;
  no_prony.active.erase(no_prony.active.begin());
  no_support.active.pop_back();
  const Eigen::VectorXd f = session.forward->predicted(0, model);
  int b = 0;
  while (session.forward->phase_of(0, b) != "hold") ++b;
  const double expected = (f - session.forward->predicted(0, no_prony))(b) * (f - session.forward->predicted(0, no_support))(b) / f(b);
  EXPECT_NEAR(both(b, 2 * first.cols()), expected, 1e-12);
  EXPECT_GT(std::abs(expected), 1e-3 * f(b));
}

/// With a large relaxation missing from the model a run's own gain looks like more than gain; with it in the model it is gain.
TEST(Misfit, NoiseIsRenewedAtTheModelThatFits) {
  const Model truth = tissue_with("prony", 0.4, {3});
  const Set set = measured(truth, {0.01, -0.01, 0.0, 0.06, -0.01});
  Session session = prepared(set);
  const auto beyond_gain = [&] {
    Eigen::MatrixXd change = 0.06 * session.forward->predicted(3, truth);
    session.problem.whiteners[3].whiten(change);
    return change.squaredNorm() - std::pow(0.06 / session.noise.sd[0], 2);
  };
  const double before = beyond_gain();
  renew_noise(session, truth);
  EXPECT_LT(beyond_gain(), 8);
  EXPECT_GT(before, 20);
}

}  // namespace palpate::loop
