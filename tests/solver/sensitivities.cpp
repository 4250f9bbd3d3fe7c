// Sensitivities against central differences of whole runs over the same steps: laws, effects with memory, tool, friction, loads.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tests/verify/case_runs.hpp>

using namespace palpate;

namespace {

using SensitivitiesOfARun = verify::CaseRuns;

const std::string base = R"(
[base]
plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }
)";
const std::string soft = "[material]\nlaw = \"neo_hookean\"\nmu = 0.0067\n";
/// A ball that comes aslant, so that it slides; the caller says how rough it is and where it goes.
const std::string slanting = R"([tool]
kind = "ball"
radius_mm = 3.0
aim_mm = [0.3, 0.2, 5.0]
axis = [0.4, 0.0, -1.0]
)";
const std::string top = "plane = { point_mm = [0.0, 0.0, 4.99], normal = [0.0, 0.0, -1.0] }\n";

}  // namespace

TEST_F(SensitivitiesOfARun, LawsAndEffectsThatRemember) {
  write(R"(
[material]
law = "fung_demiray"
mu = 0.0067
b = 1.3
[[effect]]
name = "permanent_set"
fraction = 0.2
yield = 0.03
[[effect]]
name = "mullins"
inverse_r = 0.3
m = 0.0005
[[effect]]
name = "rate"
m = 0.05
rate_0 = 0.01
[[effect]]
name = "prony"
g = [0.2, 0.0]
tau_s = [0.5, 5.0]
[tool]
kind = "ball"
radius_mm = 3.0
aim_mm = [0.3, 0.2, 5.0]
axis = [0.1, 0.0, -1.0]
path = [[0, 0], [1, 1.0], [2, 1.0], [3, 0.5], [4, 1.2]]
[steps]
count = 8
)" + base);
  expect_derivatives({"material.mu", "material.b", "effect[0].fraction", "effect[0].yield", "effect[1].inverse_r", "effect[1].m", "effect[2].m",
                      "effect[2].rate_0", "effect[3].g[0]", "effect[3].tau_s[0]", "effect[3].g[1]", "tool.aim_mm[0]", "tool.axis[0]",
                      "tool.radius_mm"});
}

TEST_F(SensitivitiesOfARun, FrictionRemembersToo) {
  write(soft + "kappa = 0.05\n" + slanting + R"(friction = 0.2
path = [[0, 0], [1, 0.8], [2, 0.4], [3, 0.8]]
[steps]
count = 9
)" + base);
  expect_derivatives({"material.mu", "material.kappa", "tool.friction", "tool.radius_mm"});
}

/// What slid sticks in the hold, in the run and in its shadows.
TEST_F(SensitivitiesOfARun, FrictionInALongHold) {
  write("[material]\nlaw = \"fung_demiray\"\nmu = 0.0067\nb = 1.3\n[[effect]]\nname = \"prony\"\ng = 0.3\ntau_s = 1.0\n" + slanting + R"(friction = 0.2
path = [[0, 0], [1, 0.8], [2, 0.8], [3, 0.5]]
[steps]
count = 9
)" + base);
  expect_derivatives({"material.mu", "material.b", "effect[0].g", "tool.friction", "tool.radius_mm", "tool.aim_mm[0]"});
}

TEST_F(SensitivitiesOfARun, LoadsAndSupport) {
  write(R"(
[material]
law = "mooney_rivlin"
C10 = 0.002
C01 = 0.0
[[effect]]
name = "prony"
g = 0.0
tau_s = 1.0
[[spring]]
stiffness_N_mm3 = 0.01
plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }
[gravity]
direction = [0.1, 0.0, -1.0]
steps = 2
acceleration_m_s2 = 9.81
[[displacement]]
motion_mm = [0.2, 0.0, -0.6]
)" + top + "[[force]]\ntotal_N = [0.01, 0.0, 0.0]\nbox = { min_mm = [4.9, -6, 1], max_mm = [6, 6, 4] }\n[steps]\ncount = 4\n");
  expect_derivatives({"material.C10", "material.C01", "effect[0].g", "spring[0].stiffness_N_mm3", "gravity.acceleration_m_s2",
                      "displacement[0].motion_mm[2]", "force[0].total_N[0]"});
}

/// A block held below, whose side slides on a bed, is pressed and held for three steps.
TEST_F(SensitivitiesOfARun, ASlidingSupportInALongHold) {
  write(R"([material]
law = "fung_demiray"
mu = 0.0067
b = 1.3
[[effect]]
name = "support"
stiffness = 0.005
tangential = 0.5
friction = 0.4
box = { min_mm = [-6.0, -6.0, -1.0], max_mm = [-4.9, 6.0, 6.0] }
[tool]
kind = "ball"
radius_mm = 3.0
aim_mm = [0.3, 0.2, 5.0]
axis = [0.1, 0.0, -1.0]
path = [[0, 0], [1, 0.9], [2, 0.9], [3, 0.5]]
[steps]
count = 9
)" + base);
  expect_derivatives({"effect[0].stiffness", "effect[0].tangential", "effect[0].friction"});
}

TEST_F(SensitivitiesOfARun, AToolThatTurns) {
  write(soft + slanting + R"(friction = 0.3
path = [[0, 0], [1, 0.8], [2, 0.8]]
turn = { about = [0.1, 1.0, 0.0], from_tip_mm = [0.2, 0.0, 4.0], path = [[0, 0], [1, 0], [2, 12]] }
[steps]
count = 6
)" + base);
  expect_derivatives({"material.mu", "tool.friction", "tool.aim_mm[0]", "tool.turn.about[0]", "tool.turn.from_tip_mm[2]", "tool.turn.path[2][1]"});
}

/// A plane that has come back to where it touched touches everywhere and presses nowhere; a step earlier it presses.
TEST_F(SensitivitiesOfARun, PointsThatTouchWithoutPressingAreOfOneSide) {
  const auto remarks_at = [&](const std::string& last) {
    write(soft + R"([tool]
kind = "plane"
aim_mm = [0.0, 0.0, 5.0]
axis = [0.0, 0.0, -1.0]
path = [[0, 0], [1, 0.4], [2, )" + last + "]]\n[steps]\ncount = 4\n" + base);
    const Settings settings = Settings::read(folder / "case.toml");
    Case c = read_case(settings, "");
    implicit::Equilibrium equilibrium(c.model, 1);
    implicit::State state = implicit::rest_state(c.model);
    Sensitivities sensitivities(settings, "", {"material.mu"}, equilibrium, 1);
    implicit::run_steps(equilibrium, state, c.steps, [](const implicit::Step&) {}, [&](const implicit::Accepted& found) { sensitivities.follow(found.state); });
    EXPECT_EQ(state.time, 2);
    return sensitivities.one_sided();
  };
  EXPECT_TRUE(remarks_at("0.1").empty());
  const auto remarks = remarks_at("0.0");
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("in 1 step(s): points touch a tool without pressing"), std::string::npos) << remarks[0];
}

/// Its depth is what answers.
TEST_F(SensitivitiesOfARun, AToolWhoseForceIsGiven) {
  write(R"(
[material]
law = "fung_demiray"
mu = 0.0067
b = 1.3
[[effect]]
name = "prony"
g = 0.3
tau_s = 1.0
[tool]
kind = "ball"
control = "force"
radius_mm = 3.0
aim_mm = [0.3, 0.2, 5.0]
axis = [0.1, 0.0, -1.0]
force_N = 0.06
friction = 0.2
duration_s = 1
[[pressure]]
pressure_MPa = 0.0002
box = { min_mm = [4.9, -6, 1], max_mm = [6, 6, 6] }
[steps]
count = 6
)" + base);
  expect_derivatives({"material.mu", "material.b", "effect[0].g", "tool.force_N", "tool.radius_mm", "tool.aim_mm[0]", "tool.friction", "pressure[0].pressure_MPa"});
}

/// In a hold any friction sticks: a secant stands in.
TEST_F(SensitivitiesOfARun, FrictionThatIsNotThereYet) {
  write(soft + slanting + R"(friction = 0.0
path = [[0, 0], [1, 0.8], [1.5, 0.8], [2, 0.4]]
[steps]
count = 6
)" + base);
  expect_secant("tool.friction", 0.05);
}

/// Also while the tool is drawn back and faces that it has left are within the range in which it would cling.
TEST_F(SensitivitiesOfARun, AdhesionThatIsNotThereYet) {
  write(soft + slanting + R"(path = [[0, 0], [1, 0.8], [2, 0.05]]
[[effect]]
name = "adhesion"
work = 0.0
range_mm = 0.5
[steps]
count = 10
)" + base);
  expect_derivatives({"effect[0].work"});
}

TEST_F(SensitivitiesOfARun, ANumberThatIsNotThereIsRefused) {
  write(soft + "[[displacement]]\nmotion_mm = [0, 0, -0.1]\n" + top + base);
  const Settings settings = Settings::read(folder / "case.toml");
  const Case c = read_case(settings, "");
  implicit::Equilibrium equilibrium(c.model, 1);
  for (const char* number : {"material.nu", "material.law", "effect[0].g", "displacement[0].motion_mm[3]"})
    EXPECT_THROW(Sensitivities(settings, "", {number}, equilibrium, 1), Failure) << number;
  EXPECT_THROW(Sensitivities(settings, "", {}, equilibrium, 1), Failure);
}
