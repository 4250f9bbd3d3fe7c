// What is not known about noise and forms, counted when explanations are compared.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <loop/forward/register.hpp>
#include <loop/methods/misfit.hpp>

namespace palpate::loop {
namespace {

const Effect* named(const std::string& name) {
  for (const Effect& effect : all_effects())
    if (effect.entry.name == name) return &effect;
  throw std::runtime_error(name);
}

/// Ramp to `depth` mm, hold, back and rest.
Run pressed(const std::string& id, const std::string& tool, double depth, const std::string& group) {
  Run run;
  run.id = id;
  run.tool = tool;
  run.replicate = group;
  run.point_mm = {0, 0, 20};
  for (int i = 0; i < 160; ++i) {
    const double t = 0.1 * i, u = depth * std::clamp(std::min(t / 4, (12 - t) / 4), 0.0, 1.0);
    run.t.push_back(t);
    run.u.push_back(u);
    run.F.push_back(0);
    run.phase.push_back(t < 4 ? "load" : t < 8 ? "hold" : t < 12 ? "unload" : "rest");
  }
  run.line.assign(run.t.size(), 1);
  run.cycle.assign(run.t.size(), 0);
  run.averaged.assign(run.t.size(), 1);
  run.fast_sd_N = 1e-4;
  return run;
}

/// A layer pressed by two balls, five runs; forces of `model`, each run with its own gain and a sensor's noise, its change by the last effect × (1 + bend (2x − 1)).
Set measured(const Model& model, const std::vector<double>& gains, double bend = 0) {
  Set set;
  set.specimen.shape = "cylinder";
  set.specimen.size_mm = {160, 160, 20};
  set.tools = {{"large", {"ball", 5.0}}, {"small", {"ball", 2.5}}};
  for (int i = 0; i < 5; ++i) set.runs.push_back(i < 3 ? pressed("r" + std::to_string(i), "large", 4, "a") : pressed("r" + std::to_string(i), "small", 2.4, "b"));
  const Forward forward(set);
  Model without = model;
  if (!without.active.empty()) without.active.pop_back();
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    const auto with = forward.force(r, model), base = forward.force(r, without);
    for (std::size_t k = 0; k < with.size(); ++k)
      set.runs[r].F[k] = (1 + gains[r]) * (base[k] + (with[k] - base[k]) * (1 + bend * (2 * set.runs[r].u[k] / 4 - 1))) + 1e-4 * normal(random);
  }
  return set;
}

Model tissue_with(const std::string& effect, double amplitude, std::vector<double> shape) {
  Model model;
  model.law = &law_named("neo_hookean");
  model.parameters = {0.01};
  model.active.push_back({named(effect), amplitude, std::move(shape)});
  return model;
}

const std::vector<double> quiet = {0.002, -0.002, 0.001, 0.002, -0.002};

}  // namespace

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
  model.active.push_back({named("support"), 0.2, {}});
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
