// The null model before it is fitted: a law with the numbers that the set gives, or typical ones.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/session.hpp>

#include <algorithm>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate::loop {
namespace {

/// Parameters that the set itself gives belong to the law and lie in its ranges; those of a case are the solver's to judge.
void expect_parameters(const Set& set, const Law& law) {
  if (!set.specimen.case_file.empty() || law.name != set.specimen.law) return;
  for (const auto& [name, value] : set.specimen.parameters) {
    const auto known = std::find_if(law.parameters.begin(), law.parameters.end(), [&](const Parameter& p) { return p.name == name; });
    std::string names;
    for (const Parameter& p : law.parameters) names += (names.empty() ? "" : ", ") + p.name;
    if (known == law.parameters.end()) throw Failure(ExitCode::misuse, "the law " + law.name + " has no parameter " + name, set.file.string() + ", [specimen] parameters", "its own: " + names);
    if (!(value >= known->range.min && value <= known->range.max)) {
      std::ostringstream text;
      text << name << " = " << value << " lies outside of " << known->range.min << " to " << known->range.max << " " << known->unit;
      throw Failure(ExitCode::misuse, text.str(), set.file.string() + ", [specimen] parameters", "a start within it; the fit goes on from there");
    }
  }
}

}  // namespace

Model start_model(const Set& set, const std::string& law) {
  Model model;
  model.law = &law_named(law);
  expect_parameters(set, *model.law);
  for (const Parameter& p : model.law->parameters) {
    const auto given = set.specimen.parameters.find(p.name);
    model.parameters.push_back(given == set.specimen.parameters.end() ? p.typical : std::clamp(given->second, p.range.min, p.range.max));
  }
  if (set.compliance_mm_per_N.state == Known::State::given || set.compliance_mm_per_N.state == Known::State::prior)
    model.compliance_mm_per_N = set.compliance_mm_per_N.value;
  if (set.gain.state == Known::State::given || set.gain.state == Known::State::prior) model.gain = set.gain.value - 1;
  return model;
}

}  // namespace palpate::loop
