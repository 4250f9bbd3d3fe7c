// Preparing a set: crude weights, null fit, noise, null fit again.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/session.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <palpate/errors.hpp>
#include <loop/forward/register.hpp>
#include <loop/methods/left_out.hpp>
#include <loop/methods/parallel.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

using Eigen::VectorXd;

namespace {

double sensor_sd_of(const Set& set, std::string& source) {
  if (set.sensor_sd_N.state == Known::State::given) {
    source = "given";
    return set.sensor_sd_N.value;
  }
  std::vector<double> air, all;
  double largest = 0;
  for (const Run& run : set.runs) {
    if (run.role != Role::holdout) (run.is_air() ? air : all).push_back(run.fast_sd_N);
    if (run.role == Role::fit)
      for (double F : run.F) largest = std::max(largest, std::abs(F));
  }
  source = air.empty() ? "fast fluctuations of all runs" : "air";
  std::vector<double>& of = air.empty() ? all : air;
  std::nth_element(of.begin(), of.begin() + of.size() / 2, of.end());
  return std::max(of[of.size() / 2], 1e-5 * largest);
}

/// Weights before anything is known of the noise: 2 % of the run's largest force for every block, and 2 % of gain.
Noise crude_noise(double sensor_sd) {
  Noise noise;
  noise.sensor_sd = sensor_sd;
  noise.scatter = 0.02;
  noise.sd[0] = 0.02;
  return noise;
}

/// Without replicates nothing is known of the noise: every block of a run weighs alike, and errors in N decide the ranking. What slow directions
/// leave of a coarse misfit must not: a fit would go where it hides best (decision 041).
Noise unrepeated_noise(double sensor_sd) {
  Noise noise;
  noise.sensor_sd = sensor_sd;
  noise.scatter = thresholds::prior_gain_sd;
  noise.sd[0] = thresholds::prior_gain_sd;
  return noise;
}

/// dF/du of each block, from a shift of the depth.
VectorXd slope_of(const Forward& forward, std::size_t run, const Model& model, double depth_scale) {
  static const Effect shift = [] {
    Effect effect;
    effect.entry.parameters = {{"shift", "mm", {}, 1, "shift"}};
    effect.depth = [](const Run&, double e, std::span<const double>, Path& depth) {
      for (double& d : depth) d += e;
    };
    return effect;
  }();
  Model moved = model;
  const double step = 1e-3 * depth_scale;
  moved.active.push_back({&shift, step, {}});
  return (forward.predicted(run, moved) - forward.predicted(run, model)) / step;
}

/// The modulus that fits best for the rest as it is; every law is linear in its moduli together.
void scale_moduli(const Problem& p, Model& model) {
  const Set& set = p.forward->set();
  double fy = 0, ff = 0;
  for (std::size_t run : p.runs) {
    if (set.runs[run].is_air()) continue;
    const VectorXd f = p.forward->predicted(run, model), y = p.forward->measured(run);
    fy += f.dot(y);
    ff += f.squaredNorm();
  }
  if (!(fy > 0) || !(ff > 0)) return;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const Parameter& parameter = model.law->parameters[i];
    if (parameter.unit == "MPa") model.parameters[i] = std::clamp(model.parameters[i] * fy / ff, parameter.range.min, parameter.range.max);
  }
}

/// Several starts: as it stands, and a factor of 4 up and down in every parameter but the moduli, which are scaled; where contact is unknown, also with contact
/// at a quarter and at half of the deepest point: beyond it no force tells a fit the way back.
Fit best_fit(const Problem& p, const Model& start) {
  Fit best;
  best.chi2 = std::numeric_limits<double>::infinity();
  double zero_room = 0;
  for (std::size_t run : p.runs) {
    const Run& r = p.forward->set().runs[run];
    if (r.zero == "tool_start" && r.test == Test::indentation) zero_room = std::max(zero_room, *std::max_element(r.u.begin(), r.u.end()) - start.zero_mm);
  }
  for (double factor : {1.0, 0.25, 4.0}) {
    Model model = start;
    bool other = factor == 1.0;
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
      const Parameter& parameter = model.law->parameters[i];
      if (parameter.unit == "MPa" && i == 0) continue;
      model.parameters[i] = std::clamp(model.parameters[i] * factor, parameter.range.min, parameter.range.max);
      other = true;
    }
    if (!other) continue;
    for (double share : {0.0, 0.25, 0.5}) {
      model.zero_mm = start.zero_mm + share * zero_room;
      scale_moduli(p, model);
      Fit fit = fitted(p, model);
      if (fit.chi2 < best.chi2) best = std::move(fit);
      if (zero_room == 0) break;
    }
  }
  if (!best.model.law) throw Failure(ExitCode::not_converged, "the law " + start.law->name + " cannot be fitted: its misfit is no number", p.forward->set().file.string(), "palpate-loop check, and the runs' units");
  return best;
}

/// A block run: u = c F by least squares through the first sample; 2 % of the slope, or what its scatter says, as its deviation.
void add_block(const Set& set, Problem& p) {
  for (const Run& run : set.runs) {
    if (!run.is_block()) continue;
    double FF = 0, uF = 0, left = 0;
    for (std::size_t i = 0; i < run.u.size(); ++i) {
      FF += run.F[i] * run.F[i];
      uF += (run.u[i] - run.u[0]) * run.F[i];
    }
    if (!(FF > 0)) continue;
    p.block_compliance = std::max(uF / FF, 0.0);
    for (std::size_t i = 0; i < run.u.size(); ++i) left += std::pow(run.u[i] - run.u[0] - p.block_compliance * run.F[i], 2);
    p.block_compliance_sd = std::max({std::sqrt(left / FF / run.u.size()), 0.02 * p.block_compliance, 1e-5});
  }
}

/// Lateral forces; their deviation from replicates, with one pseudo-observation of how well a tool is set up by hand, and the sensor's.
void add_lateral(const Session& s, double sensor_sd, Problem& p) {
  std::map<int, std::vector<Lateral>> groups;
  double smallest = 1e300;
  for (std::size_t i = 0; i < p.runs.size(); ++i) {
    const Run& run = s.set->runs[p.runs[i]];
    if (run.role != Role::fit || run.Fx.size() != run.F.size() || run.Fy.size() != run.F.size()) continue;
    double FF = 0, xF = 0, yF = 0;
    for (std::size_t k = 0; k < run.F.size(); ++k) {
      FF += run.F[k] * run.F[k];
      xF += run.Fx[k] * run.F[k];
      yF += run.Fy[k] * run.F[k];
    }
    if (!(FF > 0)) continue;
    smallest = std::min(smallest, FF);
    p.laterals.push_back({p.runs[i], xF / FF, yF / FF, 1});
    if (s.group[i] >= 0) groups[s.group[i]].push_back(p.laterals.back());
  }
  double square = thresholds::prior_weight * thresholds::prior_lateral_sd * thresholds::prior_lateral_sd, degrees = thresholds::prior_weight;
  for (const auto& [group, list] : groups) {
    double x = 0, y = 0;
    for (const Lateral& l : list) {
      x += l.x / list.size();
      y += l.y / list.size();
    }
    for (const Lateral& l : list) square += (l.x - x) * (l.x - x) + (l.y - y) * (l.y - y);
    degrees += 2.0 * (list.size() - 1);
  }
  for (Lateral& l : p.laterals) l.sd = std::sqrt(square / degrees + sensor_sd * sensor_sd / smallest);
}

void choose_runs(Session& s) {
  std::map<std::string, int> groups;
  for (std::size_t i = 0; i < s.set->runs.size(); ++i) {
    const Run& run = s.set->runs[i];
    if (run.role != Role::fit && !run.is_air()) continue;
    s.problem.runs.push_back(i);
    s.group.push_back(run.replicate.empty() ? -1 : groups.try_emplace(run.replicate, static_cast<int>(groups.size())).first->second);
  }
  if (std::none_of(s.problem.runs.begin(), s.problem.runs.end(), [&](std::size_t r) { return s.set->runs[r].role == Role::fit; }))
    throw Failure(ExitCode::refused, "no run to fit", s.set->file.string(), "role = \"fit\" for at least one run");
}

void set_noise(Session& s, const Noise& noise) {
  s.noise = noise;
  s.problem.whiteners.clear();
  for (const NoiseShape& shape : s.shapes) s.problem.whiteners.emplace_back(shape, noise);
}

void shape_noise(Session& s, const Model& model) {
  s.shapes.clear();
  for (std::size_t run : s.problem.runs)
    s.shapes.push_back(noise_shape(*s.forward, run, s.forward->predicted(run, model), slope_of(*s.forward, run, model, s.depth_scale_mm), s.depth_scale_mm));
}

/// Directions and variances of the noise at a fitted model.
void noise_around(Session& s, const Model& model, double sensor_sd) {
  shape_noise(s, model);
  Model at = model;
  const Stacked left = residual(s.problem, at);
  std::vector<VectorXd> of_run;
  Eigen::Index begin = 0;
  for (std::size_t run : s.problem.runs) {
    of_run.push_back(left.data.col(0).segment(begin, s.forward->blocks(run)));
    begin += s.forward->blocks(run);
  }
  const Noise noise = estimate_noise(s.shapes, of_run, s.group, sensor_sd);
  set_noise(s, noise.replicate_degrees > 0 ? noise : unrepeated_noise(sensor_sd));
}

void choose_law(Session& s) {
  for (const Law& law : laws()) {
    if (law.parameters.size() > 2 || law.name == "hooke_linear") continue;
    const Fit fit = best_fit(s.problem, start_model(*s.set, law.name));
    const double excess = left_out_excess(s.problem, fit.model, s.threads);
    s.laws.push_back({law.name, std::isnan(excess) ? fit.chi2 + 2 * law.parameters.size() : excess, fit.model});
  }
}

}  // namespace

Session prepared(const Set& set, const std::function<void(Forward&)>& correct) {
  Session s;
  s.set = &set;
  s.forward = std::make_unique<Forward>(set);
  if (correct) correct(*s.forward);
  s.problem.forward = s.forward.get();
  choose_runs(s);
  add_block(set, s.problem);
  double deepest = 0;
  for (const Run& run : set.runs)
    if (run.test == Test::indentation && run.role == Role::fit) deepest = std::max(deepest, *std::max_element(run.u.begin(), run.u.end()));
  s.depth_scale_mm = deepest > 0 ? deepest : 1;
  const double sensor_sd = sensor_sd_of(set, s.sensor_source);
  add_lateral(s, sensor_sd, s.problem);
  std::string law = set.specimen.law == "unknown" ? "neo_hookean" : set.specimen.law;
  for (int round = 0; round < 2; ++round) {  // the second round knows the noise's directions at a fitted model
    const Model start = round == 0 ? start_model(set, law) : s.null.model;
    if (round == 0) {
      shape_noise(s, start);
      set_noise(s, crude_noise(sensor_sd));
      if (set.specimen.law == "unknown") {
        choose_law(s);
        law = std::min_element(s.laws.begin(), s.laws.end(), [](const auto& a, const auto& b) { return a.left_out_error < b.left_out_error; })->law;
      }
    }
    s.null = best_fit(s.problem, round == 0 ? start_model(set, law) : start);
    noise_around(s, s.null.model, sensor_sd);
  }
  s.null = best_fit(s.problem, s.null.model);
  return s;
}

Fit renew_noise(Session& s, const Model& model) {
  noise_around(s, model, s.noise.sensor_sd);
  s.null = fitted(s.problem, s.null.model);
  return fitted(s.problem, model);
}

Model with_equal_weights(const Session& s, const Model& model) {
  Problem p = s.problem;
  p.whiteners.clear();
  Noise equal;
  equal.scatter = 0.02;
  for (const NoiseShape& shape : s.shapes) p.whiteners.emplace_back(shape, equal);
  return fitted(p, model).model;
}

}  // namespace palpate::loop
