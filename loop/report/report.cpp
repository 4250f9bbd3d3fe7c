// The report.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/report/report.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <loop/methods/thresholds.hpp>
#include <loop/report/errors.hpp>

namespace palpate::loop {
namespace {

std::string unit_in(const Session& s, const std::string& unit) {
  const bool stress = s.set->runs[s.problem.runs.front()].test != Test::indentation;
  return stress && (unit == "N" || unit == "N/s" || unit == "N^-1") ? "MPa" + unit.substr(1) : unit;
}

/// What the column u of the runs is.
std::string motion_of(const Session& s) {
  const auto is = [&](auto what) { return std::any_of(s.problem.runs.begin(), s.problem.runs.end(), [&](std::size_t r) { return what(s.set->runs[r]); }); };
  if (is([&](const Run& run) { return run.test == Test::indentation; })) return s.set->specimen.shape == "tube" ? "closure (mm)" : "indentation (mm)";
  const bool sheared = is([](const Run& run) { return run.test == Test::simple_shear; }), stretched = is([](const Run& run) { return run.test != Test::simple_shear; });
  return !sheared ? "stretch" : stretched ? "stretch, or amount of shear" : "amount of shear";
}

std::string joined(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? " " + last + " " : ", ") + words[i];
  return text;
}

std::string told(const Finding& f, const std::vector<std::string>& names) {
  std::vector<std::string> sentences;
  for (const std::string& name : names)
    for (const Candidate& c : f.candidates)
      if (c.effect->entry.name == name) sentences.push_back(name + " (" + c.effect->entry.sentence + ")");
  return joined(sentences, "together with");
}

Json error_json(const ErrorOf& e) {
  return {{"N", e.rms_N}, {"percent", e.percent}, {"times_noise_floor", e.times_noise}, {"interval_N", {e.low_N, e.high_N}}, {"runs", e.runs}};
}

Json errors_json(const Session& s, const Model& model) {
  Json json = {{"fit", error_json(error_of(s, model, Role::fit))}, {"holdout", nullptr}};
  if (const ErrorOf sealed = error_of(s, model, Role::holdout); sealed.runs > 0) json["holdout"] = error_json(sealed);
  return json;
}

std::string percent(double x) {
  std::ostringstream out;
  out.precision(2);
  out << x << " %";
  return out.str();
}

}  // namespace

Json noise_json(const Session& s) {
  return {{"sensor_sd", s.noise.sensor_sd}, {"sensor_source", s.sensor_source}, {"unit", unit_in(s, "N")}, {"scatter_relative", s.noise.scatter},
          {"correlation", s.noise.correlation}, {"gain_sd_relative", s.noise.sd[0]}, {"contact_sd_mm", s.noise.sd[1] * s.depth_scale_mm},
          {"drift_sd_relative", s.noise.sd[2]}, {"replicate_degrees", s.noise.replicate_degrees}, {"floor", noise_floor(s)}};
}

Json blind_spots_json(const Session& s, const Finding& f) {
  Json list = Json::array();
  for (const BlindSpot& b : f.blind_spots) {
    const Candidate& c = f.candidates[b.candidate];
    Json like = Json::array();
    for (int other : b.like) like.push_back(f.candidates[other].effect->entry.name);
    list.push_back({{"effect", c.effect->entry.name}, {"parameter", c.effect->entry.parameters[0].name}, {"unit", unit_in(s, c.effect->entry.parameters[0].unit)},
                    {"smallest_visible", finite_or_null(b.smallest_visible)}, {"largest_plausible", c.largest()}, {"visible", b.visible},
                    {"told", b.visible ? "" : "your protocol cannot see this"}, {"cannot_be_told_from", like}});
  }
  for (const Candidate& c : f.candidates)
    if (!c.pruned.empty()) list.push_back({{"effect", c.effect->entry.name}, {"visible", false}, {"told", c.pruned}});
  return list;
}

Json candidates_json(const Session& s, const Finding& f) {
  Json list = Json::array();
  for (std::size_t step = 0; step < f.steps.size(); ++step)
    for (const Tried& t : f.steps[step]) {
      const Effect& e = *f.candidates[t.candidate].effect;
      Json json = {{"step", step + 1}, {"effect", e.entry.name}, {"kind", e.entry.kind}, {"z", t.z}, {"lambda_linear", t.lambda_linear}, {"refitted", t.refitted}};
      if (t.refitted) {
        json["lambda"] = t.lambda;
        json["p"] = t.p;
        json["amplitude"] = t.fit.model.active.back().amplitude;
        json["shape"] = t.fit.model.active.back().shape;
        json["unit"] = unit_in(s, e.entry.parameters[0].unit);
        json["left_out_fall"] = finite_or_null(t.left_out_fall);
      }
      json["reason"] = t.reason;
      list.push_back(json);
    }
  for (const Candidate& c : f.candidates)
    if (!c.pruned.empty()) list.push_back({{"step", 0}, {"effect", c.effect->entry.name}, {"kind", c.effect->entry.kind}, {"reason", c.pruned}});
  return list;
}

Json parameters_json(const Session& s, const Fit& fit) {
  Model model = fit.model;
  Json list = Json::array();
  const auto parameters = fit_parameters(model, *s.set);
  int blocks = 0;
  for (std::size_t run : s.problem.runs) blocks += s.forward->blocks(run);
  const double misfit = std::max(1.0, fit.chi2 / std::max(blocks, 1));  // Birge 1932, Phys. Rev. 40:207: what is not explained widens
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const FitParameter& p = parameters[i];
    const double sd = p.sd(misfit * fit.covariance(i, i)), x = p.coordinate();
    const auto value = [&](double at) { return p.logarithmic ? std::exp(std::clamp(at, -60.0, 60.0)) : at; };
    if (p.told_inverse && *p.value > 0) {  // a limit
      const double low = std::max(x - 1.96 * sd, 1e-12), high = x + 1.96 * sd;
      list.push_back({{"name", p.name}, {"value", 1 / *p.value}, {"unit", unit_in(s, "N")}, {"interval", {1 / high, 1 / low}}, {"range", {nullptr, nullptr}}, {"source", "fit"}});
      continue;
    }
    list.push_back({{"name", p.name}, {"value", *p.value}, {"unit", unit_in(s, p.unit)},
                    {"interval", {std::max(value(x - 1.96 * sd), p.low), std::min(value(x + 1.96 * sd), p.high)}},
                    {"range", {finite_or_null(p.low), finite_or_null(p.high)}},
                    {"source", p.prior_sd > 0 ? "prior and fit" : "fit"}});
  }
  return list;
}

Json next_experiment(const Session& s, const Finding& f) {
  if (s.noise.replicate_degrees == 0)
    return {{"run", "repeat one of the runs twice and give all three the same replicate"}, {"why", "without replicates nothing can be claimed"}};
  std::vector<const Effect*> open;
  for (const auto& names : f.alternatives)
    for (const std::string& name : names)
      for (const Candidate& c : f.candidates)
        if (c.effect->entry.name == name && !c.effect->separates.empty()) open.push_back(c.effect);
  if (f.alternatives.size() < 2 || open.empty()) {
    if (f.kind == VerdictKind::unexplained) return {{"run", "repeat the runs where the residual table shows structure"}, {"why", "nothing in the catalogue explains it"}};
    return nullptr;
  }
  std::stable_sort(open.begin(), open.end(), [](const Effect* a, const Effect* b) { return a->cost < b->cost; });
  return {{"run", open.front()->separates}, {"why", "it tells " + open.front()->entry.name + " from what else is left"}, {"cost", open.front()->cost}};
}

std::string sentence(const Session& s, const Finding& f) {
  const ErrorOf before = error_of(s, f.reported_before, Role::fit), after = error_of(s, f.reported_after, Role::fit);
  const std::string errors = " The error falls from " + percent(before.percent) + " to " + percent(after.percent) + " of the largest force.";
  std::vector<std::string> sets;
  for (const auto& names : f.alternatives) sets.push_back(told(f, names));
  switch (f.kind) {
    case VerdictKind::claimed: return "The model lacks " + told(f, f.alternatives.front()) + "." + errors;
    case VerdictKind::confounded: return "The model lacks one of these, which this data cannot tell apart: " + joined(sets, "or") + "." + errors;
    case VerdictKind::unexplained:
      if (!f.oddities.empty())
        return "The measurements show what no effect of the catalogue does: " + f.oddities.front().told + "." +
               (sets.empty() ? std::string() : " The nearest effect is " + sets.front() + ", which is not claimed.") + " The error is " + percent(after.percent) + " of the largest force.";
      return "The measurements differ from the model by more than noise, and nothing in the catalogue explains it" +
             (sets.empty() ? std::string(".") : "; nearest is " + sets.front() + ".") + " The error is " + percent(after.percent) + " of the largest force.";
    case VerdictKind::nothing_supported: return "The model agrees with the measurements as far as these agree among themselves: no missing effect is supported. The error is " + percent(before.percent) + " of the largest force.";
    case VerdictKind::ranking_only:
      return "There are no replicates, so nothing is claimed" + (sets.empty() ? "; no candidate stands out." : "; first in the ranking is " + sets.front() + "." + errors);
  }
  return "";
}

Json oddities_json(const Finding& f) {
  Json list = Json::array();
  for (const Oddity& o : f.oddities)
    list.push_back({{"kind", o.kind}, {"run", o.run}, {"size", o.size}, {"t_s", o.t_s}, {"u_mm", o.u_mm}, {"frequency_Hz", o.frequency_Hz},
                    {"strength", o.strength}, {"told", o.told}});
  return list;
}

Json verdict_json(const Session& s, const Finding& f) {
  const bool names_effects = f.kind == VerdictKind::claimed || f.kind == VerdictKind::confounded;
  return {{"kind", kind_name(f.kind)}, {"effects", names_effects ? Json(f.alternatives.front()) : Json::array()}, {"alternatives", f.alternatives},
          {"distance", f.alternative_distance}, {"sentence", sentence(s, f)}};
}

Json diagnosis_json(const Session& s, const Finding& f) {
  return {{"verdict", verdict_json(s, f)}, {"residuals", {{"before", residual_table(s, f.reported_before)}, {"after", residual_table(s, f.reported_after)}}},
          {"candidates", candidates_json(s, f)}, {"oddities", oddities_json(f)}, {"parameters", parameters_json(s, f.final)}, {"sealed_looks", 0}};
}

Json validation_json(const Session& s, const Finding& f, int looks) {
  Json runs = Json::array();
  for (const Run& run : s.set->runs)
    if (run.role == Role::holdout) {
      const auto of = [&](const Model& model) { return error_json(error_of(s, model, Role::holdout, run.id)); };
      runs.push_back({{"run", run.id}, {"before", of(f.reported_before)}, {"after", of(f.reported_after)}});
    }
  return {{"schema", "palpate-loop-validation/1"}, {"verdict", verdict_json(s, f)}, {"before", error_json(error_of(s, f.reported_before, Role::holdout))},
          {"after", error_json(error_of(s, f.reported_after, Role::holdout))}, {"runs", runs}, {"noise_floor", noise_floor(s)}, {"sealed_looks", looks + 1}};
}

Json plan_json(const Session& s, const Finding& f) {
  Json list = Json::array();
  if (const Json first = next_experiment(s, f); !first.is_null()) list.push_back(first);
  std::vector<const Effect*> unseen;
  for (const BlindSpot& b : f.blind_spots)
    if (!b.visible || !b.like.empty()) unseen.push_back(f.candidates[b.candidate].effect);
  for (const Candidate& c : f.candidates)
    if (!c.pruned.empty() && c.effect->absent.empty()) unseen.push_back(c.effect);
  std::stable_sort(unseen.begin(), unseen.end(), [](const Effect* a, const Effect* b) { return a->cost < b->cost; });
  for (const Effect* e : unseen)
    if (!e->separates.empty()) list.push_back({{"run", e->separates}, {"why", "it would show " + e->entry.name + ", which this protocol cannot see or tell from others"}, {"cost", e->cost}});
  return list;
}

namespace {

/// Every law that was tried, with its error over the fitted runs and its force on the way down in the first one.
Json laws_json(const Session& s) {
  const std::size_t first = s.problem.runs.front();
  const auto u = s.forward->averaged(first, s.set->runs[first].u);
  Eigen::Index deepest = 0;
  u.maxCoeff(&deepest);
  Json list = Json::array();
  for (const LawTried& l : s.laws) {
    Json curve = Json::array();
    const auto force = s.forward->predicted(first, l.model);
    for (Eigen::Index b = 0; b <= deepest; ++b) curve.push_back({u(b), force(b)});
    list.push_back({{"law", l.law}, {"left_out_excess", l.left_out_error}, {"percent", error_of(s, l.model, Role::fit).percent}, {"run", s.set->runs[first].id}, {"first_loading", curve}});
  }
  return list;
}

}  // namespace

Json report_json(const Session& s, const Finding& f, int looks) {
  Json json;
  json["unit"] = unit_in(s, "N");
  json["motion"] = motion_of(s);
  json["schema"] = "palpate-loop-report/1";
  json["specimen"] = s.set->specimen.id;
  json["law"] = s.null.model.law->name;
  if (!s.laws.empty()) json["laws_tried"] = laws_json(s);
  json["verdict"] = verdict_json(s, f);
  json["error"] = {{"before", errors_json(s, f.reported_before)}, {"after", errors_json(s, f.reported_after)}};
  json["sealed_looks"] = error_of(s, s.null.model, Role::holdout).runs > 0 ? looks + 1 : 0;
  json["parameters"] = parameters_json(s, f.final);
  json["error"]["of"] = "the models fitted with every block of a run weighing the same";
  json["parameters_before"] = parameters_json(s, s.null);
  json["noise"] = noise_json(s);
  json["candidates"] = candidates_json(s, f);
  json["blind_spots"] = blind_spots_json(s, f);
  json["next_experiment"] = next_experiment(s, f);
  json["misfit"] = {{"structure_before", f.structure_before}, {"structure_after", f.structure_after}, {"limit", f.structure_limit},
                    {"chi2_before", s.null.chi2}, {"chi2_after", f.final.chi2}};
  json["residuals"] = {{"before", residual_table(s, f.reported_before)}, {"after", residual_table(s, f.reported_after)}};
  json["threshold_p"] = f.threshold_p;
  json["thresholds"] = thresholds::as_json();
  json["thresholds_hash"] = thresholds::hash();
  json["remarks"] = remarks(*s.set);
  for (const std::string& remark : f.remarks) json["remarks"].push_back(remark);
  json["oddities"] = oddities_json(f);
  return json;
}

std::string curves_csv(const Session& s, const Finding& f) {
  std::ostringstream out;
  out.precision(8);
  out << "run,role,phase,t[s],u[mm],measured[N],before[N],after[N],noise[N]\n";
  const double floor = noise_floor(s);
  static const char* roles[] = {"fit", "holdout", "calibration"};
  for (std::size_t r = 0; r < s.set->runs.size(); ++r) {
    const Run& run = s.set->runs[r];
    if (run.is_block()) continue;
    const auto t = s.forward->times(r), u = s.forward->averaged(r, run.u), y = s.forward->measured(r), before = s.forward->predicted(r, f.reported_before),
               after = s.forward->predicted(r, f.reported_after);
    for (int b = 0; b < y.size(); ++b)
      out << run.id << "," << roles[static_cast<int>(run.role)] << "," << s.forward->phase_of(r, b) << "," << t(b) << "," << u(b) << "," << y(b) << ","
          << before(b) << "," << after(b) << "," << floor << "\n";
  }
  return out.str();
}

Json solves_json(const std::vector<SiteCurve>& curves) {
  Json list = Json::array();
  for (const auto& curve : curves) {
    Json changes = Json::array();
    for (const auto& change : curve.changes) {
      Json solved = Json::array();  // the force with it over that without, half way down and at the deepest
      for (const auto& c : change.curves) solved.push_back({{"amplitude", c.amplitude}, {"half_way", std::exp(c.at(0.5 * curve.deepest_mm))}, {"deepest", std::exp(c.at(curve.deepest_mm))}});
      changes.push_back({{"of", change.of}, {"solved", solved}});
      if (change.of == "inclusion") changes.back()["depth_mm"] = change.depth_of_it_mm;
      if (!change.failure.empty()) changes.back()["failure"] = change.failure;
    }
    list.push_back({{"tool", curve.tool}, {"point_mm", curve.point_mm}, {"deepest_mm", curve.deepest_mm}, {"solved_over_closed", curve.factor},
                    {"scatter", curve.scatter}, {"finer_mesh_shift", curve.mesh_shift}, {"finer_mesh_apart", curve.mesh_apart}, {"memory_mm", curve.memory_mm}, {"memory_missed", curve.memory_missed}, {"nodes", curve.nodes}, {"solves", curve.solves}, {"changes", changes}});
  }
  return list;
}

Json tried_json(const std::vector<CurveTried>& curves) {
  Json list = Json::array();
  for (const auto& t : curves)
    list.push_back({{"strains", name_of(t.strains)}, {"effects", t.effects}, {"chi2", t.chi2}, {"verdict", kind_name(t.kind)}});
  return list;
}

}  // namespace palpate::loop
