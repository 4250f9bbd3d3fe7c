// What is told beside a finding.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <loop/methods/alternatives.hpp>
#include <tests/loop/pressed_layer.hpp>

namespace palpate::loop {
namespace {

/// A further effect that passed the threshold, of which relevance alone says no.
Tried beside(const Session& session, Model model, const std::string& effect, double amplitude, std::vector<double> shape) {
  model.active.push_back({named(effect), amplitude, std::move(shape)});
  Tried tried;
  tried.fit = fitted(session.problem, model);
  tried.unproven = true;
  tried.p = 1e-4;
  return tried;
}

using Names = std::vector<std::vector<std::string>>;

}  // namespace

/// The data do not exclude it: the finding with it is an alternative. Not what fits worse than another such one, what did not pass the threshold, or what was tried beside another finding.
TEST(Alternatives, WhatOnlyRelevanceSpeaksAgainst) {
  Model truth = tissue_with("prony", 0.2, {3});
  truth.active.push_back({named("support"), 0.2, {0}});
  const Set set = measured(truth, quiet);
  Session session = prepared(set);
  Finding finding;
  finding.final = fitted(session.problem, tissue_with("prony", 0.2, {3}));
  finding.alternatives = {{"prony"}};
  finding.alternative_distance = {0};
  const Tried right = beside(session, finding.final.model, "support", 0.2, {0}), worse = beside(session, finding.final.model, "friction", 0.05, {0});
  ASSERT_GT(worse.fit.chi2, right.fit.chi2 + 40) << "the case tests nothing";
  const auto told = [&](std::vector<Tried> tried) {
    Finding f = finding;
    f.steps = {std::move(tried)};
    add_unproven(session, f, 1e-3);
    return f.alternatives;
  };
  EXPECT_EQ(told({right, worse}), (Names{{"prony"}, {"prony", "support"}}));
  Tried proven = right, likely = right, elsewhere = right;
  proven.unproven = false;  // relevance had nothing to say: it was taken, or is none
  likely.p = 0.01;
  elsewhere.fit = fitted(session.problem, tissue_with("support", 0.2, {0}));
  for (const Tried& none : {proven, likely, elsewhere}) EXPECT_EQ(told({none}), (Names{{"prony"}}));
  EXPECT_EQ(told({likely, worse}), (Names{{"prony"}, {"prony", "friction"}}));  // the best of those that count
}

}  // namespace palpate::loop
