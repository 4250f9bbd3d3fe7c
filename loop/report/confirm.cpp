// Two solves of one run; changes compared at the corners of its motion.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/report/confirm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include <palpate/errors.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/text_file.hpp>
#include <loop/forward/case_curve.hpp>
#include <loop/forward/shape_mesh.hpp>
#include <loop/methods/parallel.hpp>
#include <loop/methods/thresholds.hpp>
#include <loop/report/case_file.hpp>
#include <loop/set/thinned.hpp>

namespace palpate::loop {
namespace {

namespace fs = std::filesystem;

bool observes(const Effect& e) { return !e.tissue; }

/// The model without what the solver would be asked for.
Model without_solved(const Session& s, const Model& model) {
  Model without = model;
  std::erase_if(without.active, [&](const Active& a) { return in_case(s, model, a); });
  return without;
}

/// The fitted indentation that the effects change most.
std::size_t most_changed(const Session& s, const Model& model, const Model& without) {
  std::size_t best = s.set->runs.size();
  double largest = 0;
  for (std::size_t r : s.problem.runs) {
    const Run& run = s.set->runs[r];
    if (run.role != Role::fit || run.test != Test::indentation || run.is_air() || run.is_block()) continue;
    const double change = (s.forward->predicted(r, model) - s.forward->predicted(r, without)).norm();
    if (change > largest) {
      largest = change;
      best = r;
    }
  }
  return best;
}

/// Samples at which the run is solved: moving phases in even parts, holds at times that grow, rests at their end.
std::vector<int> corners(const Run& run) {
  constexpr int moving = 6, still = 4;
  std::vector<int> at;
  const auto begins = stretches(run);
  for (std::size_t s = 0; s + 1 < begins.size(); ++s) {
    const int first = begins[s], last = begins[s + 1] - 1;
    const bool moves = run.phase[(first + last) / 2] != "hold" && run.phase[(first + last) / 2] != "rest";
    at.push_back(first);
    const int parts = moves ? moving : run.phase[(first + last) / 2] == "rest" ? 1 : still;
    for (int k = 1; k <= parts; ++k) {
      const double share = moves ? static_cast<double>(k) / parts : std::pow(2.0, k - parts);
      at.push_back(first + static_cast<int>(std::lround(share * (last - first))));
    }
  }
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

std::string motion_text(const Run& run, const Path& depth, const std::vector<int>& at) {
  std::ostringstream path, times;
  path.precision(9);
  times.precision(9);
  path << "path = [[0, 0]";
  times << "[steps]\ntimes_s = [";
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double t = run.t[at[i]] - run.t[at[0]];
    path << ", [" << t << ", " << std::max(depth[at[i]], 0.0) << "]";
    times << (i > 1 ? ", " : "") << t;
  }
  return path.str() + "]\n" + times.str() + "]\nmost_cuts = 8\nframes = 1\n";
}

std::string press_text(double deepest) {
  std::ostringstream text;
  text.precision(9);
  text << "depth_mm = " << deepest << "\n[steps]\ncount = 14\nmost_cuts = 8\nframes = 1\n";
  return text.str();
}

fs::path mesh_of(const Session& s, const Run& run, const fs::path& folder, Confirmation& c) {
  const Specimen& specimen = s.set->specimen;
  if (!specimen.case_file.empty()) return mesh_of_case(specimen.case_file);
  const double R = s.set->tools.at(run.tool).radius_mm, deepest = *std::max_element(run.u.begin(), run.u.end());
  const TetMesh mesh = shape_mesh(specimen, run.point_mm, 0.6 * std::min(std::sqrt(R * deepest), R));
  c.nodes = static_cast<int>(mesh.points.size());
  write_mesh(folder / "mesh.vtu", mesh);
  return folder / "mesh.vtu";
}

/// Force at each corner after the first.
std::vector<double> solved(const Session& s, const Model& model, const Run& run, const Path& depth, const std::vector<int>& at, const fs::path& mesh, const fs::path& solver, const fs::path& kept,
                           const fs::path& plain) {
  write_text(plain, case_text(s, model, run, ""));
  std::vector<double> force;
  if (!remembers(plain)) {
    double deepest = 0;
    for (int i : at) deepest = std::max(deepest, depth[i]);
    const SolvedCurve curve = curve_of(solved_case(case_text(s, model, run, press_text(deepest)), mesh, solver, kept));
    for (std::size_t i = 1; i < at.size(); ++i) force.push_back(depth[at[i]] > 0 ? curve.at(depth[at[i]]) : 0);
    return force;
  }
  const SolvedMotion motion = solved_case(case_text(s, model, run, motion_text(run, depth, at)), mesh, solver, kept);
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double time = run.t[at[i]] - run.t[at[0]];
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < motion.t_s.size(); ++k)
      if (std::abs(motion.t_s[k] - time) < std::abs(motion.t_s[nearest] - time)) nearest = k;
    force.push_back(motion.force_N[nearest]);
  }
  return force;
}

/// The solver's changes, freed from the mesh's own error by the ratio of both null forces, against the shortcut's.
void compare(const std::vector<double>& with, const std::vector<double>& null, const std::vector<double>& ours, const std::vector<double>& ours_null, Confirmation& c) {
  double most = 0, most_null = 0, product = 0, square = 0, own = 0;
  for (std::size_t i = 0; i < null.size(); ++i) {
    most_null = std::max(most_null, std::abs(null[i]));
    most = std::max(most, std::abs(ours_null[i]));
  }
  std::vector<double> change(null.size());
  for (std::size_t i = 0; i < null.size(); ++i) {
    const double scale = std::abs(null[i]) > 0.02 * most_null ? ours_null[i] / null[i] : most / most_null;
    change[i] = scale * (with[i] - null[i]);
    const double shortcut = ours[i] - ours_null[i];
    product += change[i] * shortcut;
    square += shortcut * shortcut;
    own += change[i] * change[i];
  }
  c.ratio = product / std::max(square, 1e-300);
  c.apart = std::sqrt(std::max(own - c.ratio * product, 0.0) / std::max(own, 1e-300));
}

}  // namespace

bool Confirmation::confirmed() const {
  if (!failure.empty() || !left_out.empty()) return false;
  return effects.empty() ? !observed.empty() : apart <= thresholds::confirm_share && std::abs(ratio - 1) <= thresholds::confirm_share;
}

Confirmation confirmed(const Session& s, const Model& model, const fs::path& solver, const fs::path& kept, const fs::path& scratch, int threads,
                       const std::function<void(const std::string&)>& remark) {
  Confirmation c;
  for (const Active& a : model.active) (observes(*a.effect) ? c.observed : in_case(s, model, a) ? c.effects : c.left_out).push_back(a.effect->entry.name);
  if (c.effects.empty()) return c;
  if (s.set->specimen.shape == "tube") {
    c.failure = "a clamped wall's changes of force are those of solved closings already";
    return c;
  }
  if (!s.set->specimen.case_file.empty() && !has_one_material(s.set->specimen.case_file)) {
    c.failure = "the case has several materials, for which the loop's law stands as one";
    return c;
  }
  const Model without = without_solved(s, model);
  const std::size_t r = most_changed(s, model, without);
  if (solver.empty() || r == s.set->runs.size()) {
    c.failure = solver.empty() ? "palpate-solve was not asked" : "no indentation to solve";
    return c;
  }
  const Run& run = s.set->runs[r];
  c.run = run.id;
  remark("solving run " + run.id + " without and with what was found");
  const Path depth = s.forward->pressed(r, model).depth_mm;
  const auto at = corners(run);
  const Path ours = s.forward->pressed_along(r, model, depth), ours_null = s.forward->pressed_along(r, without, depth);
  std::vector<double> shortcut, shortcut_null;
  for (std::size_t i = 1; i < at.size(); ++i) {
    shortcut.push_back(ours[at[i]]);
    shortcut_null.push_back(ours_null[at[i]]);
  }
  try {
    fs::create_directories(scratch);
    const fs::path mesh = mesh_of(s, run, scratch, c);
    const Model* models[] = {&without, &model};
    std::vector<double> forces[2];
    for_each_index(2, threads, [&](int i) { forces[i] = solved(s, *models[i], run, depth, at, mesh, solver, kept, scratch / ("case" + std::to_string(i) + ".toml")); });
    c.solves = 2;
    compare(forces[1], forces[0], shortcut, shortcut_null, c);
  } catch (const Failure& failure) {
    c.failure = failure.what();
  }
  return c;
}

void take_size(Session& s, Finding& f, Confirmation& c) {
  if (s.set->specimen.case_file.empty() || c.solves == 0 || !c.failure.empty() || c.effects.size() != 1 || !(c.apart <= thresholds::confirm_share) || !(c.ratio > 0.2 && c.ratio < 5)) return;
  if (!s.forward->resize(c.effects.front(), c.ratio)) return;
  Model start = f.final.model;
  for (Active& a : start.active)
    if (a.effect->entry.name == c.effects.front()) a.amplitude /= c.ratio;
  f.final = fitted(s.problem, start);
  f.reported_after = with_equal_weights(s, f.final.model);
  c.taken = c.ratio;
}

Json confirmation_json(const Confirmation& c) {
  Json json = {{"confirmed", c.confirmed()}, {"effects", c.effects}, {"of_rig_or_tool", c.observed}, {"not_in_solver", c.left_out}};
  if (!c.failure.empty()) json["failure"] = c.failure;
  if (c.solves > 0) json.update({{"run", c.run}, {"solver_over_shortcut", c.ratio}, {"apart", c.apart}, {"size_taken", c.taken}, {"nodes", c.nodes}, {"solves", c.solves}});
  return json;
}

std::string told(const Confirmation& c) {
  const auto list = [](const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : " and ") + name;
    return all;
  };
  if (c.effects.empty() && c.left_out.empty()) return "";
  if (!c.left_out.empty() && c.effects.empty()) return "not confirmed in the solver, which has nothing that means the same: " + list(c.left_out);
  if (!c.failure.empty()) return "not confirmed in the solver: " + c.failure.substr(0, c.failure.find('\n'));
  char numbers[200];
  std::snprintf(numbers, sizeof numbers, "%.2f times as much as in the quick model%s, and otherwise in course by %.0f %%", c.ratio, c.taken != 1 ? ", which took that size and was fitted anew" : "", 100 * c.apart);
  return list(c.effects) + (c.confirmed() ? " confirmed in the solver" : " not confirmed in the solver") + " (run " + c.run + "): there the force changes " + numbers +
         (c.left_out.empty() ? "" : "; not put to it: " + list(c.left_out));
}

}  // namespace palpate::loop
