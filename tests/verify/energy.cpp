// The balance of energy of whole runs: it closes as steps shrink, what friction takes is not negative, and what is false does not close.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/energy_balance.hpp>
#include <tests/verify/case_runs.hpp>

using namespace palpate;
using implicit::Channel;

namespace {

class Energy : public verify::CaseRuns {
 protected:
  struct Run {
    implicit::EnergyBalance energy;
    double largest = 0;  ///< work, N mm
    double of(Channel channel) const { return energy.works()[static_cast<int>(channel)]; }
    /// What is missing, of the largest work.
    double missing() const { return std::abs(energy.imbalance()) / largest; }
    double missing_uncorrected() const { return std::abs(energy.imbalance() - energy.correction()) / largest; }
  };

  /// Every report's time is halved `halvings` times.
  Run run(int halvings = 0) {
    Case c = read_case(Settings::read(folder / "case.toml"), "");
    for (auto* plan : {&c.settling, &c.steps})
      for (int h = 0; h < halvings; ++h) {
        auto& times = plan->times;
        for (int i = static_cast<int>(times.size()) - 1; i > 0; --i) times.insert(times.begin() + i, (times[i - 1] + times[i]) / 2);
      }
    implicit::Equilibrium equilibrium(c.model, 1);
    implicit::State state = implicit::rest_state(c.model);
    state.time = (c.settling.times.empty() ? c.steps : c.settling).times.front();
    Run run{{equilibrium.assembly(), state}};
    const auto follow = [&](const implicit::Accepted& found) {
      run.energy.add(equilibrium.assembly(), found);
      for (double work : run.energy.works()) run.largest = std::max(run.largest, std::abs(work));
    };
    const auto report = [](const implicit::Step& step) { EXPECT_EQ(step.cuts, 0); };
    if (!c.settling.times.empty()) {
      take_tools_away(c);
      EXPECT_EQ(run_steps(equilibrium, state, c.settling, report, follow), c.settling.times.back());
      bring_tools(c, state);
    }
    EXPECT_EQ(run_steps(equilibrium, state, c.steps, report, follow), c.steps.times.back()) << equilibrium.trouble().cause;
    return run;
  }

  /// Twice as many steps leave less than half of it; the last ones less than `bound`.
  Run expect_closing(double bound) {
    const Run coarse = run(), fine = run(1), finest = run(2);
    std::printf("  missing %.1e %.1e %.1e, by the trapezoid rule alone %.1e %.1e %.1e\n", coarse.missing(), fine.missing(), finest.missing(),
                coarse.missing_uncorrected(), fine.missing_uncorrected(), finest.missing_uncorrected());
    EXPECT_LE(fine.missing_uncorrected(), 0.5 * coarse.missing_uncorrected());
    EXPECT_LE(finest.missing_uncorrected(), 0.5 * fine.missing_uncorrected());
    EXPECT_LE(finest.missing(), bound);
    return finest;
  }
};

const std::string base = "[base]\nplane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }\n";
const std::string soft = "[material]\nlaw = \"neo_hookean\"\nmu = 0.0067\n";
const std::string ball = "[tool]\nkind = \"ball\"\nradius_mm = 3.0\naim_mm = [0.3, 0.2, 5.0]\naxis = [0.4, 0.0, -1.0]\n";
const std::string top = "plane = { point_mm = [0.0, 0.0, 4.99], normal = [0.0, 0.0, -1.0] }\n";

}  // namespace

TEST_F(Energy, ElasticAndFrictionless) {
  write(soft + ball + "depth_mm = 1.0\n[steps]\ncount = 5\n" + base);
  const Run incompressible = expect_closing(1e-3);
  EXPECT_EQ(incompressible.of(Channel::friction), 0);
  EXPECT_GT(incompressible.energy.stored().tissue, 0.9 * incompressible.of(Channel::tools));
  write("[material]\nlaw = \"yeoh\"\nC10 = 0.003\nC20 = 0.002\nC30 = 0.001\nkappa = 0.02\nD2 = 50\n" + ball + "depth_mm = 1.0\n[steps]\ncount = 5\n" + base);
  expect_closing(1e-3);
}

TEST_F(Energy, WhatIsPressedAndLetGoGivesAllBack) {
  write(soft + ball + "path = [[0, 0], [1, 1.0], [2, 0.0]]\n[steps]\ncount = 10\n" + base);
  const Run there_and_back = run(1);
  write(soft + ball + "path = [[0, 0], [1, 1.0]]\n[steps]\ncount = 5\n" + base);
  EXPECT_LE(std::abs(there_and_back.of(Channel::tools)), 0.01 * run(1).of(Channel::tools));
}

TEST_F(Energy, FrictionTakes) {
  const std::string path = "path = [[0, 0], [1, 0.8], [2, 0.4], [3, 0.8]]\n[steps]\ncount = 9\n";
  for (const char* mu : {"0.1", "0.3"}) {
    write(soft + ball + "friction = " + mu + "\n" + path + base);
    const Run run = expect_closing(5e-3);
    EXPECT_GE(run.of(Channel::friction) - run.energy.in_slips(), mu == std::string("0.1") ? 0.01 * run.of(Channel::tools) : 0) << mu;
  }
}

TEST_F(Energy, LoadsSupportsAndLayers) {
  write(R"(
[material]
law = "mooney_rivlin"
C10 = 0.002
C01 = 0.001
[[effect]]
name = "capsule"
E_h = 0.01
tension = 0.001
box = { min_mm = [-6, 4.9, -1], max_mm = [6, 6, 6] }
[[spring]]
stiffness_N_mm3 = 0.01
plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }
[gravity]
direction = [0.1, 0.0, -1.0]
steps = 4
acceleration_m_s2 = 50
[[displacement]]
motion_mm = [0.2, 0.0, -0.6]
)" + top + "[[force]]\ntotal_N = [0.01, 0.0, 0.0]\nbox = { min_mm = [4.9, -6, 1], max_mm = [6, 6, 4] }\n"
        "[[pressure]]\npressure_MPa = 0.0005\nbox = { min_mm = [-6, -6, 1], max_mm = [-4.9, 6, 6] }\n[steps]\ncount = 4\n");
  const Run run = expect_closing(1e-4);
  for (Channel channel : {Channel::held, Channel::loads, Channel::growth}) EXPECT_GT(std::abs(run.of(channel)), 100 * run.missing() * run.largest);
  EXPECT_GT(run.energy.stored().springs, 100 * run.missing() * run.largest);
}

TEST_F(Energy, TissueThatRemembersKeepsSome) {
  write("[material]\nlaw = \"neo_hookean\"\nmu = 0.0067\n[[effect]]\nname = \"prony\"\ng = 0.5\ntau_s = 0.5\n" + ball +
        "path = [[0, 0], [1, 1.0], [2, 0.0]]\n[steps]\ncount = 10\n" + base);
  const Run run = expect_closing(1e-3);
  EXPECT_GT(run.of(Channel::tissue), 0.1 * run.largest);
}

TEST_F(Energy, ABedGivesWay) {
  write(soft + ball + "depth_mm = 0.6\n[steps]\ncount = 6\n[[effect]]\nname = \"support\"\nstiffness = 0.01\n"
        "plane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }\n");
  const Run run = expect_closing(1e-3);
  EXPECT_LT(run.of(Channel::supports), -0.1 * run.of(Channel::tools));
}

/// It begins suddenly, when the tool is there: that little is missing.
TEST_F(Energy, AToolThatClings) {
  write(soft + ball + "depth_mm = 0.6\n[steps]\ncount = 6\n[[effect]]\nname = \"adhesion\"\nwork = 0.3\nrange_mm = 0.6\n" + base);
  const Run clinging = run(1);
  EXPECT_LE(clinging.missing(), 5e-3);
  EXPECT_GT(std::abs(clinging.of(Channel::adhesion)), 0.02 * clinging.largest);
}

/// The check of the check: a force that is told 2 % too large, and energy of another law, are seen.
TEST_F(Energy, WhatIsFalseDoesNotClose) {
  write(soft + ball + "depth_mm = 1.0\n[steps]\ncount = 20\n" + base);
  Case c = read_case(Settings::read(folder / "case.toml"), "");
  implicit::Equilibrium equilibrium(c.model, 1);
  implicit::State state = implicit::rest_state(c.model);
  implicit::EnergyBalance right(equilibrium.assembly(), state), too_strong = right, other_law = right;
  run_steps(equilibrium, state, c.steps, [](const implicit::Step&) {}, [&](const implicit::Accepted& found) {
    right.add(equilibrium.assembly(), found);
    implicit::Equations told = found.equations;
    told.contact.tools[0].force *= 1.02;
    too_strong.add(equilibrium.assembly(), {found.state, told});
    told = found.equations;
    told.stored.tissue *= 0.98;
    other_law.add(equilibrium.assembly(), {found.state, told});
  });
  EXPECT_LE(right.worst_imbalance(), 1e-3);
  EXPECT_GT(too_strong.worst_imbalance(), 0.01);
  EXPECT_GT(other_law.worst_imbalance(), 0.01);
}
