// The row of springs: the elastic curve itself, Lee and Radok's integral on loading, Ting's on unloading, letting go.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <loop/forward/row.hpp>

using namespace palpate::loop;

namespace {

constexpr double stiffness = 2.0, R = 5.0;  ///< F = k √R δ^1.5
double hertz(double d) { return d > 0 ? stiffness * std::sqrt(R) * std::pow(d, 1.5) : 0; }

Row hertz_row(const Tissue& tissue, double deepest, int count = 400) {
  std::vector<double> depths, forces;
  for (int i = 0; i <= count; ++i) {
    depths.push_back(deepest * std::pow(i / double(count), 1.4));
    forces.push_back(hertz(depths.back()));
  }
  return Row(springs_of(depths, forces), tissue, deepest, true);
}

/// Ramp at v to depth d and back.
double depth_at(double t, double v, double d) { return t < d / v ? v * t : std::max(2 * d - v * t, 0.0); }

}  // namespace

TEST(Row, WithoutMemoryItIsTheElasticCurve) {
  Row row = hertz_row(Tissue{}, 3);
  for (double d : {0.5, 2.0, 3.0, 1.0, 0.2, -0.5}) EXPECT_TRUE(std::abs(row.advance(d, 0.1) - hertz(d)) <= 1e-3 * hertz(3)) << d;
}

/// F(t) = ∫₀^t₁ G(t − s) dF_el(δ(s)), ∫_t₁^t G(t − s) δ̇(s) ds = 0; t₁ = t while loading (Lee and Radok 1960; Ting 1966).
TEST(Row, FollowsTingOnLoadingAndUnloading) {
  const double g = 0.5, tau = 1.5, v = 1, deepest = 2;
  Tissue tissue;
  tissue.prony = {{g, tau}};
  Row row = hertz_row(tissue, deepest);
  const auto G = [&](double t) { return 1 - g + g * std::exp(-t / tau); };
  const double dt = 0.002;
  double peak = 0;
  for (int i = 1; i * dt < 4; ++i) {
    const double t = i * dt, force = row.advance(depth_at(t, v, deepest), dt);
    peak = std::max(peak, force);
    if (i % 150) continue;
    double t1 = t;
    if (t > deepest / v) {  // bisection for Ting's t₁ in the loading part
      double low = 0, high = deepest / v;
      const auto balance = [&](double from) {
        double sum = 0;
        for (int k = 0; k < 4000; ++k) {
          const double s = from + (t - from) * (k + 0.5) / 4000;
          sum += G(t - s) * (s < deepest / v ? v : -v) * (t - from) / 4000;
        }
        return sum;
      };
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (balance(middle) > 0 ? low : high) = middle;
      }
      t1 = balance(1e-9) < 0 ? 0 : low;
    }
    double exact = 0;
    for (int k = 0; k < 4000; ++k) {
      const double s = t1 * (k + 0.5) / 4000, ds = t1 / 4000;
      exact += G(t - s) * 1.5 * stiffness * std::sqrt(R) * std::sqrt(v * s) * v * ds;
    }
    EXPECT_TRUE(std::abs(force - exact) <= 0.004 * peak) << "t = " << t << ", " << force << " against " << exact;
  }
}

TEST(Row, HomogeneousRelaxationIsExact) {
  Tissue tissue;
  tissue.prony = {{0.4, 2.0}};
  Row row({Spring{}}, tissue, 1, false);
  row.advance(1.0, 1e-9);
  double force = 0;
  for (int i = 0; i < 30; ++i) force = row.advance(1.0, 0.1);
  EXPECT_NEAR(force, 0.6 + 0.4 * std::exp(-1.5), 1e-7);
}

TEST(Row, MullinsSoftensReloadingButNotBeyondTheOldMaximum) {
  Tissue tissue;
  tissue.mullins = 0.4;
  Row row({Spring{}}, tissue, 1, false);
  EXPECT_NEAR(row.advance(0.5, 1), 0.5, 1e-12);
  row.advance(1.0, 1);
  EXPECT_LT(row.advance(0.5, 1), 0.45);
  EXPECT_NEAR(row.advance(1.2, 1), 1.2, 1e-12);
}

/// A contact that keeps part of its deformation is left where it was pressed to, and touches nothing above.
TEST(Row, PermanentSetLeavesTheToolFreeAboveIt) {
  Tissue tissue;
  tissue.set_fraction = 0.1;
  Row row = hertz_row(tissue, 2);
  for (double d = 0; d < 2; d += 0.01) row.advance(d, 0.01);
  const double pressed = row.advance(2, 0.01);
  EXPECT_TRUE(std::abs(pressed / hertz(2) - 0.9) <= 0.01) << pressed;  // every spring carries e − 0.1 e
  for (double d = 2; d > 0; d -= 0.01) row.advance(d, 0.01);
  for (double d : {0.19, 0.1, 0.0, -0.1, 0.0, 0.19}) EXPECT_EQ(row.advance(d, 0.01), 0) << d;
  EXPECT_TRUE(std::abs(row.advance(2, 0.01) / pressed - 1) <= 1e-12);
}

TEST(Row, TrialLeavesNothingBehind) {
  Tissue tissue;
  tissue.prony = {{0.4, 1}};
  tissue.mullins = 0.3;
  Row row = hertz_row(tissue, 2), other = hertz_row(tissue, 2);
  for (double d : {0.5, 1.5, 1.0, 1.8}) {
    const double tried = row.trial(d, 0.2);
    row.trial(d + 1, 0.7);
    EXPECT_EQ(tried, row.advance(d, 0.2));
    EXPECT_EQ(other.advance(d, 0.2), tried);
  }
}

/// A spring with a length bears λ S: what has relaxed is missed on λ(now)/λ(then) of what it was.
TEST(Row, ALengthLetsWhatRelaxedCountMoreOnTheWayBack) {
  constexpr double length = 2, g = 0.2, tau = 4;
  Tissue tissue;
  tissue.prony = {{g, tau}};
  Row row({Spring{}}, tissue, 1, true, length), as_is({Spring{}}, tissue, 1, true);
  row.advance(1, 1e-6), as_is.advance(1, 1e-6);
  EXPECT_NEAR(row.advance(1, 100 * tau), (1 - g) * 1, 1e-6) << "held, it is a spring that relaxes";
  as_is.advance(1, 100 * tau);
  const double S = 1 * (1 + 1 / length), S_half = 0.5 * (1 + 0.5 / length), lambda = 1 / (1 + 0.5 / length);
  EXPECT_NEAR(row.advance(0.5, 1e-6), lambda * (S_half - g * S), 1e-6);
  EXPECT_NEAR(as_is.advance(0.5, 1e-6), 0.5 - g, 1e-6);
  EXPECT_EQ(Row({Spring{}}, Tissue{}, 1, true, length).advance(1, 1), 1) << "nothing relaxes";
}

TEST(Row, ALengthIsTheSameWithAndWithoutSofteningBeside) {
  Tissue relaxes, both;
  relaxes.prony = both.prony = {{0.3, 1}};
  both.mullins = 1e-12;
  Row one(springs_of(std::vector<double>{0, 1, 2}, std::vector<double>{0, 1, 3}), relaxes, 2, true, 3), other(springs_of(std::vector<double>{0, 1, 2}, std::vector<double>{0, 1, 3}), both, 2, true, 3);
  for (double d : {0.5, 1.5, 1.9, 1.2, 0.3, 1.4}) EXPECT_NEAR(one.advance(d, 0.4), other.advance(d, 0.4), 1e-9);
}
