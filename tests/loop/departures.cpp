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
    EXPECT_NEAR(std::abs(elastic_force(ball(), with, 4) / elastic_force(ball(), plain(), 4) - 1), 0.03, 1e-3);
    EXPECT_TRUE(d.in(with));
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
  ASSERT_TRUE(departure_named("fung_demiray").in(tissue));
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

TEST(SolvedChange, ScalesWhatTheClosedFormChanges) {
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
  const double closed_null = forward.force(0, null).back(), closed_soft = forward.force(0, soft).back();
  SiteCurve curve;
  curve.tool = "t";
  curve.deepest_mm = 4;
  curve.factor = {1.1, 0, 0};
  curve.changes = {{"compressibility", 0.05, {1.5, 0.5}, 0}};
  forward.correct(curve);
  EXPECT_NEAR(forward.force(0, null).back(), 1.1 * closed_null, 1e-6 * closed_null);
  EXPECT_NEAR(forward.force(0, soft).back(), 1.1 * (closed_null + 2 * (closed_soft - closed_null)), 1e-3 * closed_null);  // springs between the depths
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
