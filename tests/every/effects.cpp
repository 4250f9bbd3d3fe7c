// Every effect: a full entry; in a case, off is the model without, steps repeat, and every parameter has its derivative. Every effect on the
// stress besides: tangent by differences and symmetric, objective, and no energy comes out of a closed path.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tests/verify/case_runs.hpp>

using namespace palpate;

namespace palpate::effects {
/// The name of a test shows this.
void PrintTo(const Effect& tested, std::ostream* out) { *out << tested.entry.name; }
}  // namespace palpate::effects
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

class EveryStress : public testing::TestWithParam<Effect> {};

}  // namespace

TEST_P(EveryStress, AmplitudeZeroChangesNothing) {
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

TEST_P(EveryStress, ChangesSomethingOnTheWayBack) {
  const auto m = with(GetParam(), typical(GetParam()));
  const auto memory = memory_at(m, 1.2, 12);
  const Point point{on_path(1.3), 1.3, 0.1, m.law.kinematics};
  EXPECT_GE((m.respond(point, memory.data()).P - m.respond(point.F).P).norm(), 0.005 * m.respond(point.F).P.norm());
}

TEST_P(EveryStress, ATrialStepLeavesNoTrace) {
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

TEST_P(EveryStress, TangentIsTheDerivativeAndSymmetric) {
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

TEST_P(EveryStress, IsObjective) {
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
TEST_P(EveryStress, AClosedPathCostsEnergy) {
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

std::vector<Effect> on_the_stress() {
  auto list = effects::all();
  std::erase_if(list, [](const Effect& effect) { return !effect.stress.respond; });
  return list;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryStress, testing::ValuesIn(on_the_stress()), [](const auto& tested) { return tested.param.entry.name; });

/// N = ∂W/∂F, A = ∂N/∂F, and a turn of the surface turns N.
TEST(EveryLayer, ForceAndTangentAreDerivatives) {
  using Surface = Eigen::Matrix<double, 3, 2>;
  Surface F;
  F << 1.2, 0.1, -0.2, 0.8, 0.3, 0.15;
  const double h = 1e-5;
  for (const auto& effect : effects::all()) {
    if (!effect.layer.respond) continue;
    const auto respond = [&](const Surface& at) { return effect.layer.respond(at, typical(effect)); };
    const auto r = respond(F);
    const auto at = [&](int k, double step) {
      Surface moved = F;
      moved(k % 3, k / 3) += step;
      return respond(moved);
    };
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR((at(k, h).W - at(k, -h).W) / (2 * h), r.N(k % 3, k / 3), 1e-8 * r.N.norm()) << effect.entry.name;
      const Surface dN = (at(k, h).N - at(k, -h).N) / (2 * h);
      EXPECT_LE((Eigen::Map<const Eigen::Matrix<double, 6, 1>>(dN.data()) - r.A.col(k)).norm(), 1e-8 * r.A.norm()) << effect.entry.name;
    }
    const Mat3 Q = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    EXPECT_LE((respond(Q * F).N - Q * r.N).norm(), 1e-14 * r.N.norm()) << effect.entry.name;
    EXPECT_LE(r.N.norm(), 10 * effect.entry.parameters[0].typical);
  }
}

/// Holding, and sliding where it may.
TEST(EveryForce, TangentIsTheDerivative) {
  const double h = 1e-6;
  for (const auto& effect : effects::all()) {
    if (!effect.force.respond) continue;
    auto values = typical(effect);
    for (const bool more : {true, false}) {
      if (!more) values.resize(values.size() - effect.fallbacks.size()), values.insert(values.end(), effect.fallbacks.begin(), effect.fallbacks.end());
      std::vector<double> memory(effect.force.memory(values), 0.01);
      for (const Eigen::Vector3d& u : {Eigen::Vector3d(0.3, -0.2, -0.4), {0.02, 0.01, -0.4}, {0.3, 0.1, 0.4}}) {
        const auto at = [&](const Eigen::Vector3d& place) { return effect.force.respond({place, -Eigen::Vector3d(0.1, 0.2, 1).normalized()}, memory, values); };
        const auto push = at(u);
        for (int k = 0; k < 3; ++k) {
          const Eigen::Vector3d d = (at(u + h * Eigen::Vector3d::Unit(k)).traction - at(u - h * Eigen::Vector3d::Unit(k)).traction) / (2 * h);
          EXPECT_LE((d - push.by_displacement.col(k)).norm(), 1e-7 * push.by_displacement.norm() + 1e-15) << effect.entry.name;
        }
        if (effect.force.symmetric(values)) {
          EXPECT_LE((push.by_displacement - push.by_displacement.transpose()).norm(), 1e-16);
        }
        EXPECT_LE(push.traction.dot(u - (memory.empty() ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d::Constant(0.01))), 0) << "it drives";
      }
    }
  }
}

namespace {

/// Where effects of a socket want to be told where they are.
std::string further_keys(const Effect& effect) {
  const std::string socket = effects::socket(effect);
  if (socket == "layer") return "plane = { point_mm = [0.0, 0.0, 4.99], normal = [0.0, 0.0, -1.0] }\n";
  if (socket == "force") return "box = { min_mm = [-6.0, -6.0, -1.0], max_mm = [-4.9, 6.0, 6.0] }\n";
  return "";
}

/// A block with a law, an effect and a ball that presses, holds, lifts and presses again.
class EveryEffect : public verify::CaseRuns, public testing::WithParamInterface<Effect> {
 protected:
  /// `with`: the effect's table, or nothing.
  Settings case_with(const std::string& with) {
    write("[material]\nlaw = \"fung_demiray\"\nmu = 0.0067\nb = 1.3\n"
          "[base]\nplane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }\n"
          "[tool]\nkind = \"ball\"\nradius_mm = 3.0\naim_mm = [0.3, 0.2, 5.0]\naxis = [0.1, 0.0, -1.0]\n"
          "path = [[0, 0], [1, 0.9], [1.3333333333333333, 0.9], [2, 0.5], [3, 1.0]]\n[steps]\ncount = 9\n" + with);
    return Settings::read(folder / "case.toml");
  }

  std::string table(bool off) const {
    std::ostringstream out;
    out.precision(17);
    out << "[[effect]]\nname = \"" << GetParam().entry.name << "\"\n" << further_keys(GetParam());
    const auto& parameters = GetParam().entry.parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const auto& p = parameters[i];
      if (off && effects::fallback(GetParam(), i)) continue;
      const bool place = i > 0 && p.range.min < 0;  // or direction: away from what the block mirrors
      out << p.name << " = " << (off && i == 0 ? 0 : place ? p.typical + 0.1 * i : p.typical) << "\n";
    }
    return out.str();
  }
};

}  // namespace

TEST_P(EveryEffect, OffIsTheModelWithout) {
  const auto without = forces(case_with("")), off = forces(case_with(table(true))), on = forces(case_with(table(false)));
  double peak = 0, change = 0;
  for (std::size_t i = 0; i < without.size(); ++i) {
    peak = std::max(peak, std::abs(without[i]));
    change = std::max(change, std::abs(on[i] - without[i]));
  }
  for (std::size_t i = 0; i < without.size(); ++i) EXPECT_LE(std::abs(off[i] - without[i]), 1e-10 * peak);
  EXPECT_GE(change, 1e-3 * peak);
}

TEST_P(EveryEffect, ATrialStepLeavesNoTrace) {
  const Case c = read_case(case_with(table(false)), "");
  implicit::Equilibrium equilibrium(c.model, 1);
  implicit::State state = implicit::rest_state(c.model);
  for (double t : {0.3, 0.6, 0.9}) ASSERT_TRUE(equilibrium.find(state, t)) << equilibrium.trouble().cause;
  std::vector<implicit::State> found;
  for (double t : {1.2, 1.0, 1.2}) {
    implicit::State trial = state;
    implicit::Equilibrium fresh(c.model, 1);
    ASSERT_TRUE(fresh.find(trial, t));
    found.push_back(trial);
  }
  EXPECT_EQ(found[0].nodal, found[2].nodal);
  EXPECT_EQ(found[0].memory, found[2].memory);
}

TEST_P(EveryEffect, EveryParameterHasItsDerivative) {
  std::vector<std::string> numbers;
  for (const auto& p : GetParam().entry.parameters) numbers.push_back("effect[0]." + p.name);
  case_with(table(false));
  expect_derivatives(numbers);
}

/// Of one side, where the range ends.
TEST_P(EveryEffect, TheAmplitudeHasADerivativeWhereItIsOff) {
  case_with(table(true));
  const std::string amplitude = "effect[0]." + GetParam().entry.parameters[0].name;
  if (GetParam().traction.holds_on) expect_secant(amplitude, 0.05);
  else expect_derivatives({amplitude});
  // And the program says which of these is of one side.
  const Settings settings = Settings::read(folder / "case.toml");
  const Case c = read_case(settings, "");
  implicit::Equilibrium equilibrium(c.model, 1);
  const auto remarks = Sensitivities(settings, "", {amplitude}, equilibrium, 1).remarks();
  ASSERT_EQ(remarks.size(), GetParam().entry.parameters[0].range.min == 0 ? 1u : 0u);
  if (!remarks.empty()) {
    EXPECT_NE(remarks[0].find(GetParam().traction.holds_on ? "is the secant to" : "is of one side"), std::string::npos) << remarks[0];
  }
}

TEST_P(EveryEffect, EntryIsComplete) {
  const auto& entry = GetParam().entry;
  EXPECT_EQ(entry.kind, "effect");
  EXPECT_FALSE(entry.sentence.empty() || entry.reference.empty() || entry.parameters.empty());
  EXPECT_TRUE(entry.parameters[0].range.contains(0));
  EXPECT_LT(GetParam().fallbacks.size(), entry.parameters.size());
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
    const auto& p = entry.parameters[i];
    EXPECT_FALSE(p.name.empty() || p.unit.empty() || p.meaning.empty());
    EXPECT_TRUE(p.range.contains(p.typical));
    EXPECT_TRUE(!effects::fallback(GetParam(), i) || p.range.contains(*effects::fallback(GetParam(), i)));
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, testing::ValuesIn(effects::all()),
                         [](const auto& tested) { return tested.param.entry.name; });
