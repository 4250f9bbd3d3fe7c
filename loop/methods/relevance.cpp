// Changes of force by the last effect of a model, and what a law fitted to one kind of test says of the others.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/relevance.hpp>

#include <algorithm>
#include <cmath>

#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

using Eigen::VectorXd;

bool at_the_edge(const Fit& fit) {
  const Active& a = fit.model.active.back();
  const Range& range = a.effect->entry.parameters[0].range;
  return (range.min < 0 && a.amplitude <= 0.99 * range.min) || a.amplitude >= 0.99 * range.max;
}

bool one_kind_of_test(const Set& set) {
  std::vector<Test> kinds;
  for (const Run& run : set.runs)
    if (run.role == Role::fit) kinds.push_back(run.test);
  return !kinds.empty() && kinds.front() != Test::indentation && std::count(kinds.begin(), kinds.end(), kinds.front()) == static_cast<long>(kinds.size());
}

namespace {

/// How far the nominal stress of `to` departs from that of `from`, relative to its largest, in a test whose first invariant goes to `most` on
/// the side of the stretches measured.
double departure(Test test, double most, bool stretched, const Model& from, const Model& to) {
  const Tissue a = tissue_of(from), b = tissue_of(to);
  double largest = 1e-300, apart = 0;
  for (int i = 1; i <= 400; ++i) {
    const double l = stretched ? 1 + 0.025 * i : 1 - 0.0024 * i;
    const double I1 = test == Test::uniaxial ? l * l + 2 / l : test == Test::equibiaxial ? 2 * l * l + 1 / (l * l * l * l) : l * l + 1 + 1 / (l * l);
    if (I1 - 3 > most && i > 1) break;
    const double was = nominal_stress(test, l, *a.law, a.parameters, a.stiffening);
    largest = std::max(largest, std::abs(was));
    apart = std::max(apart, std::abs(nominal_stress(test, l, *b.law, b.parameters, b.stiffening) - was));
  }
  return apart / largest;
}

/// How much the last effect of a model changes the fitted forces: root mean square, relative to the largest force; of all runs together, or (`where_most`) of those of the
/// tool and place where it is most.
double change_by_last(const Session& s, const Model& model, bool where_most) {
  struct Site {
    const Run* run;
    double squares = 0, largest = 0;
    long blocks = 0;
  };
  Model without = model;
  without.active.pop_back();
  std::vector<Site> sites;
  for (std::size_t r : s.problem.runs) {
    const Run& run = s.set->runs[r];
    if (run.role != Role::fit) continue;
    auto site = std::find_if(sites.begin(), sites.end(), [&](const Site& other) { return !where_most || (other.run->tool == run.tool && norm(other.run->point_mm - run.point_mm) < 1e-6); });
    if (site == sites.end()) site = sites.insert(sites.end(), {&run});
    const VectorXd with = s.forward->predicted(r, model);
    site->squares += (with - s.forward->predicted(r, without)).squaredNorm();
    site->largest = std::max(site->largest, with.cwiseAbs().maxCoeff());
    site->blocks += with.size();
  }
  double most = 0;
  for (const Site& site : sites) most = std::max(most, std::sqrt(site.squares / std::max(site.blocks, 1L)) / std::max(site.largest, 1e-300));
  return most;
}

}  // namespace

bool made_up(const Session& s, const Model& before, const Model& after) {
  if (!one_kind_of_test(*s.set)) return false;
  double own = 0, others = 0;
  for (bool stretched : {true, false}) {
    double most = 0;
    for (std::size_t r : s.problem.runs)
      for (double u : s.set->runs[r].u) {
        const double l = s.set->runs[r].test == Test::simple_shear ? u / 2 + std::sqrt(1 + u * u / 4) : u;
        if ((l > 1) == stretched) most = std::max(most, l * l + 2 / l - 3);
      }
    if (!(most > 1e-3)) continue;
    const Test kind = s.set->runs[s.problem.runs.front()].test == Test::simple_shear ? Test::pure_shear : s.set->runs[s.problem.runs.front()].test;
    own = std::max(own, departure(kind, most, stretched, before, after));
    for (Test test : {Test::uniaxial, Test::equibiaxial, Test::pure_shear}) others = std::max(others, departure(test, most, stretched, before, after));
  }
  return others > thresholds::made_up * own;
}

double whitened_change_by_last(const Session& s, Model model, int blocks) {
  Model without = model;
  without.active.pop_back();
  const VectorXd with = whitened(s.problem, s.problem.whiteners, residual(s.problem, model));
  return (with - whitened(s.problem, s.problem.whiteners, residual(s.problem, without))).head(blocks).norm();
}

namespace {

bool changes_curve(const Effect& effect) { return effect.entry.kind == "material" || effect.entry.kind == "start" || effect.entry.kind == "layer"; }

}  // namespace

bool matters(const Session& s, const Model& model, bool further) {
  const Effect& last = *model.active.back().effect;
  const bool elastic = changes_curve(last) || s.set->specimen.shape == "tube";  // known to form_sd
  double known = std::hypot(s.set->curve_sd, s.set->mesh_sd * s.set->mesh_apart);  // of a clamp: half of the force, over the curve, times what its meshes differ by
  known += 0.5 * s.set->clamp_form_sd;
  const double least = further ? thresholds::further_matters : elastic ? std::max(thresholds::matters, known) : thresholds::matters;
  return last.lateral || change_by_last(s, model, further) >= least;
}

namespace {

/// Of fitted runs, N: root of the mean over runs of their mean squares.
double error_in_N(const Session& s, const Model& model) {
  const Model fit = with_equal_weights(s, model);
  double squares = 0;
  for (std::size_t run : s.problem.runs)
    if (s.set->runs[run].role == Role::fit) squares += (s.forward->measured(run) - s.forward->predicted(run, fit)).squaredNorm() / s.forward->blocks(run);
  return std::sqrt(squares);
}

/// The same of noise alone.
double noise_in_N(const Session& s) {
  double squares = 0;
  for (std::size_t i = 0; i < s.problem.runs.size(); ++i)
    if (s.set->runs[s.problem.runs[i]].role == Role::fit) squares += s.problem.whiteners[i].variance();
  return std::sqrt(squares);
}

}  // namespace

bool lowers_error(const Session& s, const Model& model) {
  const Effect& last = *model.active.back().effect;
  if (last.lateral || last.compliance) return true;
  Model without = model;
  without.active.pop_back();
  const double before = error_in_N(s, without);
  const bool of_meshes = s.set->specimen.shape == "tube" || (!s.set->specimen.case_file.empty() && changes_curve(last));  // known to no better than what meshes differ by
  const bool within_noise = of_meshes && before <= noise_in_N(s);
  return error_in_N(s, model) <= (1 - (within_noise ? thresholds::relevance : thresholds::error_fall)) * before;
}

double excess(const Session& s, double chi2) {
  for (std::size_t run : s.problem.runs) chi2 -= s.forward->blocks(run);
  return std::max(chi2, 0.0);
}

}  // namespace palpate::loop
