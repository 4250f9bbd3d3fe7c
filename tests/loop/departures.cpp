// Departures from a neo-Hookean tissue: closed forms know them as the solver's text says them, and a solved change scales the closed one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <loop/forward/departures.hpp>
#include <loop/forward/model.hpp>

namespace palpate::loop {
namespace {

Tissue plain() {
  Tissue tissue;
  tissue.law = &law_named("neo_hookean");
  tissue.parameters = {0.01};
  return tissue;
}

Site ball() {
  Site site;
  site.tool = {"ball", 5.0};
  return site;
}

TEST(Departures, AmplitudeIsThatOfTheAskedChange) {
  for (const Departure& d : departures()) {
    SCOPED_TRACE(d.name);
    const double e = amplitude_of(d, ball(), plain(), 4, 0.03);
    Tissue with = plain();
    d.add(with, e);
    const double change = std::abs(elastic_force(ball(), with, 4) / elastic_force(ball(), plain(), 4) - 1);
    if (d.name == "prestress" || d.name == "thickness") EXPECT_LT(change, 1e-3) << "the closed form of a half-space knows it";
    else EXPECT_NEAR(change, 0.03, 1e-3);
    EXPECT_NEAR(d.amplitude(with), e, 1e-12 * e);
    d.remove(with);
    EXPECT_FALSE(d.in(with));
    EXPECT_DOUBLE_EQ(elastic_force(ball(), with, 4), elastic_force(ball(), plain(), 4));
  }
}

TEST(Departures, ANullLawIsOneToo) {
  Tissue tissue = plain();
  tissue.law = &law_named("fung_demiray");
  tissue.parameters = {0.01, 1.5};
  Tissue same = plain();
  same.stiffening.exponential = 1.5;
  EXPECT_NEAR(elastic_force(ball(), tissue, 4), elastic_force(ball(), same, 4), 1e-9);
  ASSERT_EQ(departure_named("fung_demiray").amplitude(tissue), 1.5);
  departure_named("fung_demiray").remove(tissue);
  EXPECT_EQ(tissue.law->name, "neo_hookean");
  EXPECT_DOUBLE_EQ(tissue.parameters.at(0), 0.01);
}

TEST(Departures, TextSaysEveryOne) {
  Tissue tissue = plain();
  tissue.stiffening.exponential = 0.5;
  tissue.nu = 0.45;
  tissue.capsule_N_per_mm = 0.02;
  EXPECT_EQ(material_text(tissue), "[material]\nlaw = \"fung_demiray\"\nmu = 0.01\nb = 0.5\nkappa = 0.0966666666667\n[[effect]]\nname = \"capsule\"\nE_h = 0.02\n");
}

/// One run that presses 4 mm deep.
Set pressed() {
  Set set;
  set.specimen.case_file = "case.toml";
  set.tools["t"] = {"ball", 5.0};
  Run run;
  run.tool = "t";
  for (int i = 0; i <= 40; ++i) {
    run.t.push_back(0.1 * i);
    run.u.push_back(0.1 * i);
    run.F.push_back(0);
    run.averaged.push_back(1);
    run.phase.push_back("load");
  }
  set.runs.push_back(run);
  return set;
}

TEST(SolvedChange, GoesThroughTheSolvedSizes) {
  SolvedChange change;
  change.of = "compressibility";
  change.curves = {{0.02, {1, 3}, {-0.01, -0.02}}, {0.06, {1, 3}, {-0.024, -0.05}}};
  EXPECT_DOUBLE_EQ(change.log_ratio(0, 2), 0);
  EXPECT_NEAR(change.log_ratio(0.02, 2), -0.015, 1e-15);
  EXPECT_NEAR(change.log_ratio(0.06, 0.5), -0.024, 1e-15) << "above the first depth as at it";
  EXPECT_NEAR(change.log_ratio(0.06, 9), -0.05, 1e-15);
  EXPECT_NEAR(change.log_ratio(-1e-6, 1) / change.log_ratio(1e-6, 1), -1, 1e-4) << "its slope does not turn at zero";
  EXPECT_LT(change.log_ratio(0.08, 1), change.log_ratio(0.06, 1));
  change.curves[1].log_ratio = {-0.005, -0.005};  // turns back
  EXPECT_NEAR(change.log_ratio(0.5, 1), -0.005, 1e-15);
}

TEST(SolvedChange, TakesThePlaceOfTheClosedFormsChange) {
  const Set set = pressed();
  Forward forward(set);
  Model null, soft;
  null.law = &law_named("neo_hookean");
  null.parameters = {0.01};
  soft = null;
  Effect effect;
  effect.entry.parameters = {{"e", "1", {}, 1, ""}};
  effect.tissue = [](double e, std::span<const double>, Tissue& t) { t.nu -= e; };
  soft.active.push_back({&effect, 0.05, {}});
  const double closed_null = forward.force(0, null).back();
  SiteCurve curve;
  curve.tool = "t";
  curve.deepest_mm = 4;
  curve.factor = {1.1, 0, 0};
  curve.changes.resize(1);
  curve.changes[0].of = "compressibility";
  curve.changes[0].curves = {{0.05, {1, 4}, {-0.2, -0.2}}};
  forward.correct(curve);
  EXPECT_NEAR(forward.force(0, null).back(), 1.1 * closed_null, 1e-6 * closed_null);
  EXPECT_NEAR(forward.force(0, soft).back(), 1.1 * std::exp(-0.2) * closed_null, 1e-3 * closed_null);  // springs between the depths
}

TEST(SolvedSize, IsWhatTheRowTakesForTheSolversAmplitude) {
  const Set set = pressed();
  Forward forward(set), half(set);
  Effect friction;
  friction.entry.parameters = {{"mu", "1", {}, 1, ""}};
  friction.tissue = [](double e, std::span<const double>, Tissue& t) { t.friction += e; };
  Model model;
  model.law = &law_named("neo_hookean");
  model.parameters = {0.01};
  const double without = forward.force(0, model).back();
  model.active.push_back({&friction, 0.2, {}});
  SiteCurve curve;
  curve.tool = "t";
  curve.deepest_mm = 4;
  curve.sizes = {{"friction", 0.5}};
  half.correct(curve);
  EXPECT_NEAR(half.force(0, model).back() - without, 0.5 * (forward.force(0, model).back() - without), 1e-12);
}

TEST(SolvedChange, TheMeshesDifferenceIsADirectionOfTheCurve) {
  const Set set = pressed();
  Forward forward(set);
  Model model;
  model.law = &law_named("neo_hookean");
  model.parameters = {0.01};
  const double before = forward.force(0, model).back();
  SiteCurve curve;
  curve.tool = "t";
  curve.deepest_mm = 4;
  curve.mesh_depth_mm = {1, 4};
  curve.mesh_change = {-0.2, -0.1};
  forward.correct(curve);
  EXPECT_DOUBLE_EQ(forward.force(0, model).back(), before);
  model.mesh_form = 0.5;
  EXPECT_NEAR(forward.force(0, model).back(), std::exp(-0.05) * before, 1e-3 * before);
}

}  // namespace
}  // namespace palpate::loop
