// Tissue that remembers, as a block pulled along x, against closed forms: Prony's relaxation and ramp, Mullins' way back, the rate's
// overstress that is gone at rest, the stretch that stays; amplitude 0 is the model without.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/steps.hpp>
#include <tests/verify/shapes.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

const double mu = 0.0067;

/// Stretch over time, from 1.
using Path = std::vector<std::array<double, 2>>;

struct Pulled {
  std::vector<double> nominal;  ///< stress at the times asked for, MPa
  implicit::State state;
};

/// A unit block pulled uniaxially along a path, in steps that end at `times`.
Pulled pull(const elements::Material& m, const Path& stretch, const std::vector<double>& times) {
  auto model = brick(uniform(0, 1, 2), uniform(0, 1, 2), uniform(0, 1, 2));
  for (int c = 0; c < 3; ++c) hold(model, c, [c](const Vector3d& x) { return x(c) < 1e-9; });
  Amplitude ramp;
  for (const auto& [t, l] : stretch) ramp.points.push_back({t, l - 1});
  model.amplitudes.push_back(ramp);
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].x() > 1 - 1e-9) model.prescribed.push_back({int(i), 0, 1, 1});
  model.materials = {m};
  implicit::NewtonLimits limits;
  limits.tolerance = 1e-11;
  implicit::Equilibrium equilibrium(model, 1, limits);
  Pulled pulled{{}, implicit::rest_state(model)};
  for (double t : times) {
    const auto found = equilibrium.find(pulled.state, t);
    if (!found) throw std::runtime_error(std::to_string(t) + " s: " + equilibrium.trouble().cause);
    double sum = 0;
    for (std::size_t i = 0; i < model.points.size(); ++i)
      if (model.points[i].x() > 1 - 1e-9) sum += found->equations.residual(4 * i);
    pulled.nominal.push_back(sum);
  }
  return pulled;
}

std::vector<double> even_times(double end, int steps) {
  std::vector<double> times;
  for (int i = 1; i <= steps; ++i) times.push_back(end * i / steps);
  return times;
}

double neo_hookean(double l) { return mu * (l - 1 / (l * l)); }

}  // namespace

/// After a sudden stretch, of the elastic stress 1 − Σ g (1 − exp(−t/τ)) is left; the second Piola-Kirchhoff stress' parts along and
/// across relax alike at a constant stretch, so the nominal stress does too.
TEST(Prony, UniaxialHold) {
  auto m = material("neo_hookean", {mu});
  m.add(effect_named("prony"), {0.3, 0.5, 0.2, 4});
  const double sudden = 1e-9;
  const std::vector<double> times = {sudden, 0.1, 0.5, 1, 3, 10, 40};
  const auto pulled = pull(m, {{0, 1}, {sudden, 1.4}}, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double left = 1 - 0.3 * (1 - std::exp(-times[i] / 0.5)) - 0.2 * (1 - std::exp(-times[i] / 4));
    EXPECT_LE(std::abs(pulled.nominal[i] / (left * neo_hookean(1.4)) - 1), 1e-6) << times[i];
  }
}

/// A small ramp of rate r for a time T, then hold: linear viscoelasticity, σ = 3 μ r [(1 − Σ g) t + Σ g τ (1 − exp(−t/τ))] on the ramp
/// (Christensen 1982, Theory of Viscoelasticity, §1.2).
TEST(Prony, SmallRampAndHold) {
  auto m = material("hooke_linear", {3 * mu, 0.5});
  const double g = 0.4, tau = 0.7, T = 1, strain = 1e-3;
  m.add(effect_named("prony"), {g, tau});
  const auto times = even_times(2, 8);
  const auto pulled = pull(m, {{0, 1}, {T, 1 + strain}, {2, 1 + strain}}, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i], ramp = std::min(t, T);
    const double fading = g * tau * (std::exp(-(t - ramp) / tau) - std::exp(-t / tau));
    EXPECT_LE(std::abs(pulled.nominal[i] / (3 * mu * strain / T * ((1 - g) * ramp + fading)) - 1), 1e-8) << t;
  }
}

TEST(Mullins, TheWayBackAndUpAgain) {
  auto m = material("neo_hookean", {mu});
  const double inverse_r = 0.4, width = 0.3 * mu;
  m.add(effect_named("mullins"), {inverse_r, width});
  const Path path = {{0, 1}, {1, 1.6}, {2, 1}, {3.5, 1.9}};
  const std::vector<double> times = {0.5, 1, 1.25, 1.5, 1.75, 2.5, 2.9, 3.1, 3.5};
  const auto pulled = pull(m, path, times);
  const auto energy = [](double l) { return mu / 2 * (l * l + 2 / l - 3); };
  Amplitude stretch{path};
  double peak = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double l = stretch.at(times[i]);
    peak = std::max(peak, energy(l));
    const double eta = 1 - inverse_r * std::erf((peak - energy(l)) / width);
    EXPECT_LE(std::abs(pulled.nominal[i] - eta * neo_hookean(l)), 1e-8 * neo_hookean(1.6)) << times[i];
  }
  EXPECT_LT(pulled.nominal[2], 0.95 * neo_hookean(stretch.at(1.25)));  // that there is a way back at all
}

/// Small strain at a constant rate r: σ = 3 μ ε (1 + m ln(1 + r/r0)), and σ = 3 μ ε as soon as it stops.
TEST(Rate, OverstressIsGoneAtRest) {
  auto m = material("hooke_linear", {3 * mu, 0.5});
  const double factor = 0.08, rate_0 = 1e-4, rate = 1e-3;
  m.add(effect_named("rate"), {factor, rate_0});
  const auto times = even_times(1, 20);
  const auto pulled = pull(m, {{0, 1}, {0.75, 1 + 0.75 * rate}}, times);
  for (std::size_t i = 2; i < times.size(); ++i) {  // the first step has no elastic stress before it, the second no growth
    const double moving = times[i] <= 0.75 ? 1 + factor * std::log1p(rate / rate_0) : 1;
    EXPECT_LE(std::abs(pulled.nominal[i] / (3 * mu * rate * std::min(times[i], 0.75) * moving) - 1), 1e-8) << times[i];
  }
}

/// Held at a stretch λ: α = fraction (ln λ − yield) has become permanent, the stress is that of ln λ − α; free of stress again at the
/// stretch exp(α). While it grows, what stays is a step late: an error of first order in the step.
TEST(PermanentSet, StretchThatStays) {
  auto m = material("neo_hookean", {mu});
  const double fraction = 0.3, yield = 0.1, l = 1.5, stays = std::exp(fraction * (std::log(l) - yield)), elastic = l / stays;
  const double held = mu * (elastic * elastic - 1 / elastic) / l;
  m.add(effect_named("permanent_set"), {fraction, yield});
  std::vector<double> late;
  for (int steps : {10, 20, 40}) {
    auto times = even_times(1, steps);
    times.insert(times.end(), {1.1, 1.3, 1.5, 1.8, 2});
    const auto pulled = pull(m, {{0, 1}, {1, l}, {1.1, l}, {2, stays}}, times);
    late.push_back(std::abs(pulled.nominal[steps - 1] / held - 1));
    EXPECT_LE(std::abs(pulled.nominal[steps] / held - 1), 1e-9);
    EXPECT_LE(std::abs(pulled.nominal.back()), 1e-10 * held);
  }
  EXPECT_GT(late[0], 0.01);  // there is something to converge
  EXPECT_NEAR(late[0] / late[1], 2, 0.2);
  EXPECT_NEAR(late[1] / late[2], 2, 0.2);
}

TEST(Effects, AmplitudeZeroIsTheModelWithout) {
  const auto times = even_times(1, 5);
  const auto plain = pull(material("fung_demiray", {mu, 1.5}), {{0, 1}, {1, 1.3}}, times);
  for (const auto& effect : effects::all()) {
    if (!effect.stress.respond) continue;
    auto m = material("fung_demiray", {mu, 1.5});
    std::vector<double> values;
    for (const auto& p : effect.entry.parameters) values.push_back(p.typical);
    values[0] = 0;
    m.add(effect, values);
    const auto off = pull(m, {{0, 1}, {1, 1.3}}, times);
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_LE(std::abs(off.nominal[i] - plain.nominal[i]), 1e-10 * std::abs(plain.nominal[i])) << effect.entry.name;
  }
}
