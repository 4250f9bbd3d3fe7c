// Coulomb between organs: a block pressed by N on a wider one and dragged sideways: the tangential force at gross slip is μ N, below it sticks; also
// where both are one region that touches itself. Derivatives and energy of whole runs; a coefficient of 0 is none.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <solver/implicit/energy_balance.hpp>
#include <tests/solver/newtons_order.hpp>
#include <tests/verify/case_runs.hpp>
#include <tests/verify/organs.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

/// The lower block of 9 × 7 × 2 mm and the upper one of 4 × 4 × 3 mm on it, their meshes not matching.
implicit::Model two_blocks(int* faces_of_lower = nullptr) {
  auto model = brick(uniform(-3, 6, 7), uniform(-3.5, 3.5, 5), uniform(-2, 0, 2));
  if (faces_of_lower) *faces_of_lower = int(model.faces.size());
  append(model, brick(uniform(-2, 2, 4), uniform(-2, 2, 3), uniform(0, 3, 3)));
  return model;
}

/// The top is pressed down by 0.3 mm until t = 1, then dragged along x by up to 2.4 mm at t = 4. The lower block is a hundred times as stiff, so
/// that the edges of the upper one do not cut into it.
implicit::Model dragged(double friction, bool itself = false) {
  int lower = 0;
  auto model = two_blocks(&lower);
  model.materials = {material("neo_hookean", {0.0067}), material("neo_hookean", {0.67})};
  for (std::size_t t = 0; t < model.tets.size(); ++t) model.tet_material[t] = implicit::centroid(model, t).z() < 0;
  model.amplitudes = {{}, {{{0, 0}, {1, 1}}}, {{{1, 0}, {4, 1}}}};
  for (int c = 0; c < 3; ++c) hold(model, c, [](const Vector3d& x) { return x.z() < -2 + 1e-9; });
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].z() > 3 - 1e-9)
      for (int c = 0; c < 3; ++c) model.prescribed.push_back({int(i), c, c == 2 ? -0.3 : c == 0 ? 2.4 : 0.0, c == 2 ? 1 : 2});
  if (!itself) {
    touch(model, lower, friction);
    return model;
  }
  std::vector<int> all(model.faces.size());
  std::iota(all.begin(), all.end(), 0);
  model.passes = contact::passes_between(all, {}, true, 0, friction);
  return model;
}

struct Row {
  double time;
  Vector3d top, base, passed;  ///< forces on the upper block's top, on the lower one's base, of the upper on the lower one, N
  double slid;                 ///< mean motion of the upper block's underside against the face below it, mm
};

double slid(const implicit::Model& model, const implicit::State& state) {
  double sum = 0, nodes = 0, below = 0, nodes_below = 0;
  const int first_of_upper = 8 * 6 * 3;
  for (int i = 0; i < int(model.points.size()); ++i) {
    const auto& x = model.points[i];
    if (std::abs(x.z()) > 1e-9 || x.head<2>().norm() > 1.6) continue;
    (i >= first_of_upper ? sum : below) += state.displacement(i).x();
    ++(i >= first_of_upper ? nodes : nodes_below);
  }
  return sum / nodes - below / nodes_below;
}

std::vector<Row> rows(const implicit::Model& model, const std::vector<double>& times, int* cuts = nullptr) {
  implicit::Equilibrium equilibrium(model, 1);
  auto state = implicit::rest_state(model);
  std::vector<Row> list;
  const double reached = run_steps(equilibrium, state, {times}, [&](const implicit::Step& step) {
    if (step.index == 0) return;
    Row row{step.state.time, Vector3d::Zero(), Vector3d::Zero(), step.equations.contact.organs[0].force, slid(model, step.state)};
    for (const auto& p : model.prescribed) (p.amplitude > 0 ? row.top : row.base)(p.component) += step.equations.residual(4 * p.node + p.component);
    list.push_back(row);
    if (cuts) *cuts += step.cuts;
  });
  if (reached < times.back()) throw std::runtime_error(equilibrium.trouble().cause);
  return list;
}

const std::vector<double> all_the_way = {0, 0.5, 1, 1.4, 1.8, 2.2, 2.6, 3, 3.5, 4};

}  // namespace

TEST(RubbingOrgans, AtGrossSlipThePullIsMuTimesThePress) {
  for (double friction : {0.1, 0.3})
    for (bool itself : {false, true}) {
      const auto list = rows(dragged(friction, itself), all_the_way);
      const Row& last = list.back();
      std::printf("  mu %.1f%s: pull %.6f N, press %.6f N, ratio %.5f, slid %.2f mm\n", friction, itself ? ", one region" : "", last.top.x(), -last.top.z(),
                  -last.top.x() / last.top.z(), last.slid);
      EXPECT_GT(-last.top.z(), 0.01);
      EXPECT_GT(last.slid, 1);
      EXPECT_LE(std::abs(-last.top.x() / last.top.z() / friction - 1), 0.01);
      for (const Row& row : list) {  // what one feels, the other feels, the other way
        EXPECT_LE((row.top + row.base).norm(), 1e-7 * row.top.norm()) << row.time;
        if (!itself) {
          EXPECT_LE((row.passed + row.base).norm(), 1e-7 * row.top.norm()) << row.time;
        }
      }
    }
}

TEST(RubbingOrgans, BelowItSticks) {
  const auto list = rows(dragged(0.8), {0, 0.5, 1, 1.1});
  const Row &pressed = list[list.size() - 2], &last = list.back();
  std::printf("  pull %.6f N of %.6f N that friction can carry, slid %.6f mm of 0.08\n", last.top.x(), -0.8 * last.top.z(), last.slid - pressed.slid);
  EXPECT_LT(last.top.x(), 0.9 * 0.8 * -last.top.z());
  EXPECT_GT(last.top.x(), 0.01 * -last.top.z());
  EXPECT_LE(std::abs(last.slid - pressed.slid), 0.01 * 0.08);
}

/// A step that failed leaves nothing behind: after it, smaller ones find what they find without.
TEST(RubbingOrgans, AFailedStepLeavesNothingBehind) {
  const auto model = dragged(0.3);
  implicit::NewtonLimits limits;
  limits.iterations = 3;
  implicit::Equilibrium impatient(model, 1, limits), patient(model, 1);
  auto state = implicit::rest_state(model);
  for (double t : {0.5, 1.0, 1.4, 1.8}) ASSERT_TRUE(patient.find(state, t));
  auto tried = state;
  EXPECT_FALSE(impatient.find(tried, 3));
  ASSERT_EQ(tried.pair_slips.size(), state.pair_slips.size());
  for (std::size_t i = 0; i < state.pair_slips.size(); ++i) {
    EXPECT_EQ(tried.pair_slips[i].weights, state.pair_slips[i].weights);
    EXPECT_EQ(tried.pair_slips[i].face, state.pair_slips[i].face);
    EXPECT_EQ((tried.pair_slips[i].shear - state.pair_slips[i].shear).norm(), 0);
  }
}

TEST(RubbingOrgans, NewtonsResidualsFallQuadratically) {
  for (double friction : {0.8, 0.2}) {  // sticking, sliding
    const auto model = dragged(friction);
    implicit::Equilibrium equilibrium(model, 1);
    auto state = implicit::rest_state(model);
    for (double t : {0.5, 1.0, 1.4, 1.8, 2.2}) ASSERT_TRUE(equilibrium.find(state, t)) << t;
    const auto found = equilibrium.find(state, friction > 0.5 ? 2.25 : 2.6);
    ASSERT_TRUE(found);
    const auto& pairs = found->equations.contact.pairs;
    const auto sliding = std::count_if(pairs.begin(), pairs.end(), [](const auto& place) { return place.law.answer.slides; });
    std::printf("  mu %.1f: %ld of %zu points slide\n", friction, long(sliding), pairs.size());
    auto residuals = found->residuals;
    std::erase_if(residuals, [](double r) { return r < 1e-12; });  // round-off
    expect_newtons_order(residuals);
  }
}

TEST(RubbingOrgans, ACoefficientOfZeroIsNone) {
  const std::vector<double> times = {0, 0.5, 1, 1.4, 1.8};
  const auto off = rows(dragged(0), times), small = rows(dragged(1e-12), times);
  for (std::size_t i = 0; i < off.size(); ++i) EXPECT_LE((off[i].top - small[i].top).norm(), 1e-10 * off[i].top.norm());
}

namespace {

class RubbingCase : public CaseRuns {
 protected:
  void write_blocks(const std::string& contact, const std::string& end) {
    int lower = 0;
    const auto model = two_blocks(&lower);
    TetMesh mesh = mesh_of(model);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.tet_region[t] = implicit::centroid(model, t).z() < 0 ? 1 : 2;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) mesh.face_region[f] = int(f) < lower ? 1 : 2;
    mesh.region_names = {{1, "lower"}, {2, "upper"}};
    write("[[material]]\nregion = \"lower\"\nlaw = \"neo_hookean\"\nmu = 0.05\n"
          "[[material]]\nregion = \"upper\"\nlaw = \"fung_demiray\"\nmu = 0.0067\nb = 1.3\n"
          "[base]\nplane = { point_mm = [0.0, 0.0, -1.99], normal = [0.0, 0.0, 1.0] }\n"
          "[[contact]]\nbetween = [\"lower\", \"upper\"]\n" + contact +
          "[[displacement]]\nplane = { point_mm = [0.0, 0.0, 2.99], normal = [0.0, 0.0, -1.0] }\n" + end, mesh);
  }
};

const std::string there_and_back = "motion_mm = [0.3, 0.05, -0.3]\npath = [[0, 0], [1, 1], [1.5, 0.8]]\n[steps]\ntimes_s = [0.02, 0.06, 0.15, 0.3, 0.5, 0.75, 1, 1.25, 1.5]\n";

}  // namespace

TEST_F(RubbingCase, TheKeyIsReadAndZeroChangesNothing) {
  write_blocks("", there_and_back);
  const auto without = forces(Settings::read(folder / "case.toml"));
  write_blocks("friction = 0.0\n", there_and_back);
  const auto zero = forces(Settings::read(folder / "case.toml"));
  write_blocks("friction = 0.3\n", there_and_back);
  const auto with = forces(Settings::read(folder / "case.toml"));
  EXPECT_EQ(without, zero);  // to the bit
  EXPECT_GT(std::abs(with[4] / without[4] - 1), 0.01);
  write_blocks("sticking = true\n", there_and_back);
  EXPECT_TRUE(std::isinf(read_case(Settings::read(folder / "case.toml"), "").model.passes[1].friction));
  write_blocks("friction = -0.1\n", there_and_back);
  EXPECT_THROW(read_case(Settings::read(folder / "case.toml"), ""), Failure);
}

/// To 5e-5 of the largest. The blocks stick in part and slide in part, there and on the way back.
TEST_F(RubbingCase, DerivativesAreThoseOfWholeRuns) {
  write_blocks("friction = 0.3\n", there_and_back);
  expect_derivatives({"contact[0].friction", "material[0].mu", "material[1].mu", "material[1].b", "displacement[0].motion_mm[0]", "displacement[0].motion_mm[2]"});
}

/// Points slide on by next to nothing there: their shears turn with 1e-7 mm.
TEST_F(RubbingCase, InAHoldToo) {
  write_blocks("friction = 0.3\n", "motion_mm = [0.3, 0.05, -0.3]\npath = [[0, 0], [1, 1], [2, 1]]\n[steps]\ntimes_s = [0.02, 0.06, 0.15, 0.3, 0.5, 0.75, 1, 1.25, 1.5, 2]\n");
  expect_derivatives({"contact[0].friction", "displacement[0].motion_mm[0]"});
}

TEST_F(RubbingCase, WhereItIsOffASecantStandsIn) {
  write_blocks("friction = 0.0\n", there_and_back);
  expect_secant("contact[0].friction", 0.05);
}

namespace {

/// Of a whole run, N mm.
struct Energy {
  double work, lost, in_slips, missing;
};

Energy energy_of(const std::filesystem::path& path) {
  const Case c = read_case(Settings::read(path), "");
  implicit::Equilibrium equilibrium(c.model, 1);
  implicit::State state = implicit::rest_state(c.model);
  implicit::EnergyBalance energy(equilibrium.assembly(), state);
  const double reached = run_steps(equilibrium, state, c.steps, [](const implicit::Step&) {}, [&](const implicit::Accepted& found) { energy.add(equilibrium.assembly(), found); });
  EXPECT_EQ(reached, c.steps.times.back()) << equilibrium.trouble().cause;
  const auto work = energy.works();
  const Energy e{work[static_cast<int>(implicit::Channel::held)], work[static_cast<int>(implicit::Channel::friction)] - energy.in_slips(), energy.in_slips(), energy.imbalance()};
  std::printf("  work %.6f N mm, rubbed away %.3e, in elastic slip %.3e, missing %.1e of the work\n", e.work, e.lost, e.in_slips, e.missing / e.work);
  return e;
}

}  // namespace

TEST_F(RubbingCase, WhatIsRubbedAwayIsMissingOfTheWork) {
  write_blocks("friction = 0.2\n", "motion_mm = [1.2, 0.1, -0.4]\npath = [[0, 0], [2, 1]]\n[steps]\ncount = 16\n");
  const Energy e = energy_of(folder / "case.toml");
  EXPECT_GT(e.lost, 0.05 * e.work);
  EXPECT_LE(std::abs(e.missing), 5e-3 * e.work);
}

/// The soft block bulges over the stiff one: the work of their shears is what their elastic slip stores.
TEST_F(RubbingCase, BlocksThatStickLoseNothing) {
  write_blocks("sticking = true\n", "motion_mm = [0.0, 0.0, -0.2]\n[steps]\ncount = 8\n");
  const Energy e = energy_of(folder / "case.toml");
  EXPECT_GT(e.in_slips, 0);
  EXPECT_LE(std::abs(e.lost), 1e-6 * e.in_slips);
}
