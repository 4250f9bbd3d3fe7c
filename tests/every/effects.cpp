// Every effect on the stress: off is exact, amplitude 0 changes nothing, trial steps repeat, tangent by differences and symmetric,
// objective, a full entry; and no energy comes out of a closed path.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tests/verify/shapes.hpp>

using namespace palpate;
using effects::Effect;
using effects::Mat3;
using effects::Point;
using effects::Response;
using effects::Vec9;

namespace {

std::vector<double> typical(const Effect& effect) {
  std::vector<double> values;
  for (const auto& p : effect.entry.parameters) values.push_back(p.typical);
  return values;
}

elements::Material with(const Effect& effect, std::vector<double> values, const char* law = "fung_demiray") {
  auto m = verify::material(law, std::string(law) == "hooke_linear" ? std::vector<double>{0.02, 0.5} : std::vector<double>{0.0067, 1.3});
  m.add(effect, std::move(values));
  return m;
}

/// A closed path of distortions, there and back by other ways, within 2 s.
Mat3 on_path(double t) {
  const double s = std::sin(std::acos(-1.0) * t / 2), z = std::sin(2 * std::acos(-1.0) * t / 2);
  Mat3 G;
  G << 0.35 * s, 0.2 * z, -0.1 * s, 0.05 * z, -0.25 * s, 0.3 * s, -0.2 * s, 0.1 * z, -0.1 * s;
  return Mat3::Identity() + G;
}

/// Memory after `steps` of the path up to `end`.
std::vector<double> memory_at(const elements::Material& m, double end, int steps, const Mat3& Q = Mat3::Identity()) {
  std::vector<double> memory(m.memory(), 0.0);
  for (int i = 1; i <= steps; ++i) m.remember({Q * on_path(end * i / steps), end * i / steps, end / steps, m.law.kinematics}, memory.data());
  return memory;
}

/// Moments on the way there and on the way back.
const std::vector<double> moments = {0.3, 0.9, 1.2, 1.7};

class EveryEffect : public testing::TestWithParam<Effect> {};

}  // namespace

TEST_P(EveryEffect, AmplitudeZeroChangesNothing) {
  auto values = typical(GetParam());
  values[0] = 0;
  const auto m = with(GetParam(), values);
  for (double t : moments) {
    const auto memory = memory_at(m, t, 7);
    const Point point{on_path(t + 0.1), t + 0.1, 0.1, m.law.kinematics};
    const auto off = m.respond(point.F), on = m.respond(point, memory.data());
    EXPECT_LE((on.P - off.P).norm(), 1e-10 * off.P.norm());
    EXPECT_LE((on.A - off.A).norm(), 1e-10 * off.A.norm());
  }
}

TEST_P(EveryEffect, ChangesSomethingOnTheWayBack) {
  const auto m = with(GetParam(), typical(GetParam()));
  const auto memory = memory_at(m, 1.2, 12);
  const Point point{on_path(1.3), 1.3, 0.1, m.law.kinematics};
  EXPECT_GE((m.respond(point, memory.data()).P - m.respond(point.F).P).norm(), 0.005 * m.respond(point.F).P.norm());
}

TEST_P(EveryEffect, ATrialStepLeavesNoTrace) {
  const auto m = with(GetParam(), typical(GetParam()));
  const auto memory = memory_at(m, 1.2, 12);
  auto kept = memory;
  const Point point{on_path(1.3), 1.3, 0.1, m.law.kinematics}, elsewhere{on_path(0.8), 1.4, 0.2, m.law.kinematics};
  const Response first = m.respond(point, kept.data());
  m.respond(elsewhere, kept.data());
  const Response again = m.respond(point, kept.data());
  EXPECT_EQ(kept, memory);
  EXPECT_EQ((first.P - again.P).norm(), 0);
  EXPECT_EQ((first.A - again.A).norm(), 0);
}

TEST_P(EveryEffect, TangentIsTheDerivativeAndSymmetric) {
  for (const char* law : {"fung_demiray", "hooke_linear"}) {
    const auto m = with(GetParam(), typical(GetParam()), law);
    for (double t : moments) {
      const auto memory = memory_at(m, t, 7);
      const Point point{on_path(t + 0.1), t + 0.1, 0.1, m.law.kinematics};
      const auto r = m.respond(point, memory.data());
      const double h = 1e-5;
      for (int k = 0; k < 9; ++k) {
        const auto P = [&](double step) {
          Point moved = point;
          moved.F(k % 3, k / 3) += step;
          return m.respond(moved, memory.data()).P;
        };
        const Mat3 dP = (8 * (P(h) - P(-h)) - (P(2 * h) - P(-2 * h))) / (12 * h);
        EXPECT_LE((Eigen::Map<const Vec9>(dP.data()) - r.A.col(k)).norm(), 1e-8 * r.A.norm()) << law << " at " << t;
      }
      EXPECT_LE((r.A - r.A.transpose()).norm(), 1e-12 * r.A.norm()) << law;
    }
  }
}

TEST_P(EveryEffect, IsObjective) {
  const Mat3 Q = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const auto m = with(GetParam(), typical(GetParam()));
  for (double t : moments) {
    const auto memory = memory_at(m, t, 7), turned_memory = memory_at(m, t, 7, Q);
    const Mat3 F = on_path(t + 0.1);
    const Mat3 P = m.respond({F, t + 0.1, 0.1, m.law.kinematics}, memory.data()).P;
    const Mat3 turned = m.respond({Q * F, t + 0.1, 0.1, m.law.kinematics}, turned_memory.data()).P;
    EXPECT_LE((Q * P - turned).norm(), 1e-12 * P.norm());
  }
}

/// Work in a closed path, with fine steps, J kept by the pressure: P : dF of the isochoric part is what counts.
TEST_P(EveryEffect, AClosedPathCostsEnergy) {
  const auto m = with(GetParam(), typical(GetParam()));
  std::vector<double> memory(m.memory(), 0.0);
  const int steps = 2000;
  double work = 0, peak = 0;
  Mat3 before = Mat3::Zero();
  for (int i = 1; i <= steps; ++i) {
    const Point point{on_path(2.0 * i / steps), 2.0 * i / steps, 2.0 / steps, m.law.kinematics};
    const Mat3 P = m.respond(point, memory.data()).P;
    m.remember(point, memory.data());
    work += 0.5 * (P + before).cwiseProduct(point.F - on_path(2.0 * (i - 1) / steps)).sum();
    peak = std::max(peak, m.respond(point.F).W);
    before = P;
  }
  EXPECT_GE(work, 1e-3 * peak);
  EXPECT_LE(work, peak);
}

TEST_P(EveryEffect, EntryIsComplete) {
  const auto& entry = GetParam().entry;
  EXPECT_EQ(entry.kind, "effect");
  EXPECT_FALSE(entry.sentence.empty() || entry.reference.empty() || entry.parameters.empty());
  EXPECT_EQ(entry.parameters[0].range.min, 0);
  for (const auto& p : entry.parameters) {
    EXPECT_FALSE(p.name.empty() || p.unit.empty() || p.meaning.empty());
    EXPECT_TRUE(p.range.contains(p.typical));
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, testing::ValuesIn(effects::all()),
                         [](const auto& tested) { return tested.param.entry.name; });
