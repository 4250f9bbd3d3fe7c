// Which numbers a fit may move.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/parameters.hpp>

#include <algorithm>
#include <cmath>

#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

double FitParameter::coordinate() const { return logarithmic ? std::log(*value) : *value; }
double FitParameter::sd(double variance) const { return std::hypot(std::sqrt(std::max(variance, 0.0)), accuracy * (logarithmic ? 1 : std::abs(*value))); }
bool FitParameter::is_stopped(double gradient) const { return (gradient > 0 && *value >= high) || (gradient < 0 && *value <= low); }
void FitParameter::set_coordinate(double x) { *value = std::clamp(logarithmic ? std::exp(std::clamp(x, -60.0, 60.0)) : x, low, high); }

namespace {

void add_effect(Active& active, std::vector<FitParameter>& list) {
  const auto& entry = active.effect->entry;
  const Parameter& amplitude = entry.parameters[0];
  list.push_back({entry.name + "." + amplitude.name, amplitude.unit, &active.amplitude, amplitude.range.min, amplitude.range.max, false,
                  std::max(1e-3 * amplitude.typical, active.effect->difference * std::abs(active.amplitude))});
  list.back().accuracy = active.effect->accuracy;
  list.back().told_inverse = active.effect->told_inverse;
  if (!active.effect->refines) return;
  for (std::size_t i = 0; i < active.shape.size(); ++i) {
    const Parameter& p = entry.parameters[i + 1];
    list.push_back({entry.name + "." + p.name, p.unit, &active.shape[i], p.range.min, p.range.max, true, 1e-3});
    list.back().accuracy = active.effect->accuracy;
  }
}

/// The elastic curve's own error: linear and quadratic in depth, in depth itself, and a factor and a line for each tool after the first; each within four
/// of its standard deviations, beyond which it is not the curve's.
void add_form(Model& model, const Set& set, std::vector<FitParameter>& list) {
  if (set.specimen.shape == "tube") {
    model.clamp_form.resize(set.clamp_forms);
    for (std::size_t i = 0; i < model.clamp_form.size(); ++i) list.push_back({"form." + std::to_string(i), "1", &model.clamp_form[i], -4, 4, false, 0.05, 0, 1});
    return;
  }
  for (int i : {0, 1, 2}) {
    const double sd = i < 2 ? set.curve_sd : thresholds::form_depth_sd;
    list.push_back({"form." + std::to_string(i + 1), "1", &model.form[i], -4 * sd, 4 * sd, false, 1e-4, 0, sd});
  }
  if (set.mesh_sd > 0) list.push_back({"form.mesh", "1", &model.mesh_form, -4 * set.mesh_sd, 4 * set.mesh_sd, false, 1e-3, 0, set.mesh_sd});
  std::string first;
  for (const Run& run : set.runs) {
    if (run.role != Role::fit || run.test != Test::indentation) continue;
    if (first.empty()) first = run.tool;
    if (run.tool != first) model.tool_form.try_emplace(run.tool, std::array<double, 2>{0, 0});
  }
  for (auto& [tool, form] : model.tool_form)
    for (int i : {0, 1}) {
      const double sd = i == 0 ? set.tool_size_sd : set.tool_curve_sd;
      list.push_back({"form." + tool + "." + std::to_string(i), "1", &form[i], -4 * sd, 4 * sd, false, 1e-4, 0, sd});
    }
}

}  // namespace

std::vector<FitParameter> fit_parameters(Model& model, const Set& set) {
  std::vector<FitParameter> list;
  for (std::size_t i = 0; i < model.law->parameters.size(); ++i) {
    const Parameter& p = model.law->parameters[i];
    list.push_back({p.name, p.unit, &model.parameters[i], p.range.min, p.range.max, true, 1e-3});
    list.back().accuracy = thresholds::form_sd;
  }
  if (std::any_of(set.runs.begin(), set.runs.end(), [](const Run& r) { return r.zero == "tool_start"; })) {
    double sd = 0;
    for (const Run& r : set.runs) sd = std::max(sd, r.zero_sd_mm);
    list.push_back({"zero", "mm", &model.zero_mm, -50, 50, false, 1e-3, 0, sd});
  }
  if (set.gain.state == Known::State::prior) list.push_back({"rig.gain", "1", &model.gain, -0.5, 0.5, false, 1e-4, set.gain.value - 1, set.gain.sd});
  if (set.compliance_mm_per_N.state == Known::State::prior)
    list.push_back({"rig.compliance", "mm/N", &model.compliance_mm_per_N, 0, 10, false, 1e-4, set.compliance_mm_per_N.value, set.compliance_mm_per_N.sd});
  if (std::any_of(set.runs.begin(), set.runs.end(), [](const Run& r) { return r.test == Test::indentation; })) add_form(model, set, list);
  for (Active& active : model.active) add_effect(active, list);
  return list;
}

}  // namespace palpate::loop
