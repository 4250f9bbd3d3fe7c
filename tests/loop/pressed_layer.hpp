// A layer pressed by two balls, with an effect in the forces: a set for tests of what compares explanations.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <random>

#include <loop/forward/register.hpp>
#include <loop/methods/session.hpp>

namespace palpate::loop {

inline const Effect* named(const std::string& name) {
  for (const Effect& effect : all_effects())
    if (effect.entry.name == name) return &effect;
  throw std::runtime_error(name);
}

/// Ramp to `depth` mm, hold, back and rest.
inline Run pressed(const std::string& id, const std::string& tool, double depth, const std::string& group) {
  Run run;
  run.id = id;
  run.tool = tool;
  run.replicate = group;
  run.point_mm = {0, 0, 20};
  for (int i = 0; i < 160; ++i) {
    const double t = 0.1 * i, u = depth * std::clamp(std::min(t / 4, (12 - t) / 4), 0.0, 1.0);
    run.t.push_back(t);
    run.u.push_back(u);
    run.F.push_back(0);
    run.phase.push_back(t < 4 ? "load" : t < 8 ? "hold" : t < 12 ? "unload" : "rest");
  }
  run.line.assign(run.t.size(), 1);
  run.cycle.assign(run.t.size(), 0);
  run.averaged.assign(run.t.size(), 1);
  run.fast_sd_N = 1e-4;
  return run;
}

/// A layer pressed by two balls, five runs; forces of `model`, each run with its own gain and a sensor's noise, its change by the last effect × (1 + bend (2x − 1)).
inline Set measured(const Model& model, const std::vector<double>& gains, double bend = 0) {
  Set set;
  set.specimen.shape = "cylinder";
  set.specimen.size_mm = {160, 160, 20};
  set.tools = {{"large", {"ball", 5.0}}, {"small", {"ball", 2.5}}};
  for (int i = 0; i < 5; ++i) set.runs.push_back(i < 3 ? pressed("r" + std::to_string(i), "large", 4, "a") : pressed("r" + std::to_string(i), "small", 2.4, "b"));
  const Forward forward(set);
  Model without = model;
  if (!without.active.empty()) without.active.pop_back();
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    const auto with = forward.force(r, model), base = forward.force(r, without);
    for (std::size_t k = 0; k < with.size(); ++k)
      set.runs[r].F[k] = (1 + gains[r]) * (base[k] + (with[k] - base[k]) * (1 + bend * (2 * set.runs[r].u[k] / 4 - 1))) + 1e-4 * normal(random);
  }
  return set;
}

inline Model tissue_with(const std::string& effect, double amplitude, std::vector<double> shape) {
  Model model;
  model.law = &law_named("neo_hookean");
  model.parameters = {0.01};
  model.active.push_back({named(effect), amplitude, std::move(shape)});
  return model;
}

inline const std::vector<double> quiet = {0.002, -0.002, 0.001, 0.002, -0.002};

}  // namespace palpate::loop
