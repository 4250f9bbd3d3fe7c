// The chain from displacement read to force read.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/model.hpp>

#include <algorithm>
#include <cmath>

#include <palpate/errors.hpp>
#include <loop/forward/adhesion.hpp>
#include <loop/forward/departures.hpp>
#include <loop/forward/motion_effects.hpp>
#include <loop/forward/row.hpp>
#include <loop/set/thinned.hpp>

namespace palpate::loop {
namespace {

constexpr int springs = 64;

/// About `most` blocks; every stretch of one phase has its own, in number as the square root of its samples.
std::vector<int> block_begins(const Run& run, int most) {
  const auto ends = stretches(run);
  const int count = static_cast<int>(ends.size()) - 1;
  if (count * 4 > most) {  // phases that flicker
    const int samples = ends.back(), blocks = std::min(samples, most);
    std::vector<int> begin;
    for (int b = 0; b <= blocks; ++b) begin.push_back(static_cast<int>(static_cast<long>(samples) * b / blocks));
    return begin;
  }
  double roots = 0;
  for (int s = 0; s < count; ++s) roots += std::sqrt(ends[s + 1] - ends[s]);
  std::vector<int> begin;
  for (int s = 0; s < count; ++s) {
    const int samples = ends[s + 1] - ends[s];
    const int blocks = std::clamp(static_cast<int>(std::lround(most * std::sqrt(samples) / roots)), 1, samples);
    for (int b = 0; b < blocks; ++b) begin.push_back(ends[s] + static_cast<int>(static_cast<long>(samples) * b / blocks));
  }
  begin.push_back(ends.back());
  return begin;
}

double step_s(const Run& run, std::size_t i) {
  if (!run.timed) return 1e9;  // quasi-static: everything that relaxes has relaxed
  return i > 0 ? run.t[i] - run.t[i - 1] : run.t.size() > 1 ? run.t[1] - run.t[0] : 1;
}

/// u at which the elastic force reaches that of the zero's definition.
double depth_of_force(double force, double deepest, const auto& elastic) {
  double low = 0, high = deepest;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (elastic(middle) < force ? low : high) = middle;
  }
  return low;
}

/// Of the inclusions under this place that were solved; the tissue loses them.
double of_inclusions(const SolvedChange& change, const Site& site, Tissue& tissue, double depth) {
  double log_ratio = 0;
  std::erase_if(tissue.inclusions, [&](const Inclusion& i) {
    const bool here = norm(i.point_mm - site.point_mm) < 0.5 && i.depth_mm == change.depth_of_it_mm;
    if (here) log_ratio += change.log_ratio(std::log1p(i.excess), depth);
    return here;
  });
  return log_ratio;
}

/// Linear between the solved depths, beyond them as at them.
double mesh_change(const SiteCurve& curve, double depth) {
  const auto& at = curve.mesh_depth_mm;
  if (at.empty()) return 0;
  const std::size_t i = std::upper_bound(at.begin(), at.end(), depth) - at.begin();
  if (i == 0) return curve.mesh_change.front();
  if (i == at.size()) return curve.mesh_change.back();
  const double share = (depth - at[i - 1]) / (at[i] - at[i - 1]);
  return (1 - share) * curve.mesh_change[i - 1] + share * curve.mesh_change[i];
}

/// Forces of a row under a tool whose mounting gives way by c F: F = row(u − c F), by Newton with the row's own slope.
Path row_forces(const Run& run, Row& row, const Path& depth, double compliance) {
  Path force(depth.size());
  double F = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double dt = step_s(run, i);
    if (compliance > 0) {
      const double probe = 1e-6 * (1 + std::abs(depth[i]));
      for (int iteration = 0; iteration < 8; ++iteration) {
        const double at = row.trial(depth[i] - compliance * F, dt), miss = at - F;
        if (std::abs(miss) < 1e-9 + 1e-7 * std::abs(F)) break;
        const double slope = (row.trial(depth[i] - compliance * F + probe, dt) - at) / probe;
        F += miss / (1 + compliance * std::max(slope, 0.0));
      }
    }
    F = row.advance(depth[i] - compliance * F, dt);
    force[i] = F;
  }
  return force;
}

}  // namespace

Tissue tissue_of(const Model& model) {
  Tissue tissue;
  tissue.law = model.law;
  tissue.parameters = model.parameters;
  for (const Active& a : model.active)
    if (a.effect->tissue) a.effect->tissue(a.amplitude, a.shape, tissue);
  return tissue;
}

Forward::Forward(const Set& set) : set_(&set), scale_(0) {
  int used = 0;
  for (const Run& run : set.runs) used += run.role == Role::fit;
  const int most = std::clamp(1500 / std::max(used, 1), 40, 120);
  for (const Run& run : set.runs) {
    begin_.push_back(block_begins(run, most));
    if (run.role != Role::calibration)
      for (std::size_t i = 0; i < run.u.size(); ++i) scale_ = std::max(scale_, run.test == Test::indentation ? run.u[i] : std::abs(run.F[i]));
  }
  if (!(scale_ > 0)) scale_ = 1;
}

Eigen::VectorXd Forward::samples_per_block(std::size_t run) const {
  Eigen::VectorXd count = Eigen::VectorXd::Zero(blocks(run));
  for (int b = 0; b < count.size(); ++b)
    for (int i = begin_[run][b]; i < begin_[run][b + 1]; ++i) count(b) += set_->runs[run].averaged[i];
  return count;
}

Eigen::VectorXi Forward::rows_per_block(std::size_t run) const {
  Eigen::VectorXi count(blocks(run));
  for (int b = 0; b < count.size(); ++b) count(b) = begin_[run][b + 1] - begin_[run][b];
  return count;
}

std::string Forward::phase_of(std::size_t run, int block) const {
  return set_->runs[run].phase[(begin_[run][block] + begin_[run][block + 1]) / 2];
}

Eigen::VectorXd Forward::averaged(std::size_t run, const std::vector<double>& values) const {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(blocks(run));
  for (int b = 0; b < mean.size(); ++b) {
    for (int i = begin_[run][b]; i < begin_[run][b + 1]; ++i) mean(b) += values[i];
    mean(b) /= begin_[run][b + 1] - begin_[run][b];
  }
  return mean;
}

Site Forward::site(const Run& run) const {
  Site site;
  site.tool = set_->tools.at(run.tool);
  site.point_mm = run.point_mm;
  site.strains = strains_;
  const Specimen& s = set_->specimen;
  site.bonded = s.bonded;
  if (!s.shape.empty()) site.thickness_mm = s.size_mm[2];
  if (s.shape == "ellipsoid") {  // height of the ellipsoid over its lowest point, along z, at the point
    const double x = run.point_mm[0] / (s.size_mm[0] / 2), y = run.point_mm[1] / (s.size_mm[1] / 2);
    site.thickness_mm *= std::sqrt(std::max(1 - x * x - y * y, 0.01));
  }
  return site;
}

const SiteCurve* Forward::correction(const Run& run) const {
  for (const SiteCurve& c : corrections_)
    if (c.tool == run.tool && norm(c.point_mm - run.point_mm) <= 1e-6) return &c;
  return nullptr;
}

namespace {

/// Effects of the row of springs whose amplitude a tissue has once.
const std::map<std::string, double Tissue::*>& sized() {
  static const std::map<std::string, double Tissue::*> members = {{"mullins", &Tissue::mullins}, {"permanent_set", &Tissue::set_fraction}, {"rate", &Tissue::rate},
                                                                  {"friction", &Tissue::friction}, {"adhesion", &Tissue::adhesion_J_per_m2}};
  return members;
}

}  // namespace

bool Forward::resize(const std::string& effect, double size) {
  if (!sized().contains(effect)) return false;
  for (SiteCurve& c : corrections_) c.sizes.push_back({effect, size});
  return !corrections_.empty();
}

Tissue Forward::tissue_at(const Run& run, const Model& model) const {
  Tissue tissue = tissue_of(model);
  if (const SiteCurve* c = correction(run))
    for (const SolvedSize& size : c->sizes) tissue.*sized().at(size.of) *= size.size;
  tissue.mullins = std::min(tissue.mullins, 0.98);
  tissue.set_fraction = std::min(tissue.set_fraction, 0.98);
  return tissue;
}

double Forward::elastic(const Run& run, const Site& site, const Tissue& tissue, double depth) const {
  const SiteCurve* c = correction(run);
  if (!c) return elastic_force(site, tissue, depth);
  if (!(depth > 0)) return 0;
  const double x = std::min(depth / c->deepest_mm, 1.0);
  Tissue base = tissue;
  double log_ratio = 0;
  for (const SolvedChange& change : c->changes) {
    if (change.of == "inclusion") {
      log_ratio += of_inclusions(change, site, base, depth);
      continue;
    }
    const Departure& departure = departure_named(change.of);
    log_ratio += change.log_ratio(departure.amplitude(tissue), depth);
    departure.remove(base);
  }
  return std::exp(log_ratio) * elastic_force(site, base, depth) * (c->factor[0] + x * (c->factor[1] + x * c->factor[2]));
}

Eigen::VectorXd Forward::curve_scatter(std::size_t r) const {
  Eigen::VectorXd scatter = Eigen::VectorXd::Zero(blocks(r));
  const Run& run = set_->runs[r];
  if (!clamp_ || run.test != Test::indentation || run.is_air() || run.is_block()) return scatter;
  const double largest = measured(r).cwiseAbs().maxCoeff();
  const auto here = std::count_if(set_->runs.begin(), set_->runs.end(), [&](const Run& other) { return norm(other.point_mm - run.point_mm) < 1e-6; });
  for (int b = 0; b < scatter.size(); ++b) {
    const int middle = (begin_[r][b] + begin_[r][b + 1]) / 2;
    if (run.phase[middle] == "hold" || run.phase[middle] == "rest") continue;  // at a place of the curve's own error, or out
    scatter(b) = largest * std::sqrt(static_cast<double>(here)) * clamp_->site(run.point_mm).scatter_at(run.u[middle] / clamp_->deepest_mm, run.phase[middle] == "unload");
  }
  return scatter;
}

/// What gives way in series is found by going over it four times: a clamp's rig gives way by far less than the wall.
Path Forward::clamped_force(const Run& run, const Model& model, const Tissue& tissue, Path& depth, double compliance) const {
  if (!clamp_) throw Failure(ExitCode::refused, "a clamp has no closed form: its curves are solved", set_->file.string(), "palpate-loop run, with --forward auto");
  const ClampSite& site = clamp_->site(run.point_mm);
  const Path read = depth;
  Path force;
  for (int again = 0; again < (compliance > 0 ? 4 : 1); ++again) {
    force = clamp_force(*clamp_, site, tissue, model.clamp_form, {run.t, depth});
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = read[i] - compliance * force[i];
  }
  return force;
}

Path Forward::tissue_force(const Run& run, const Model& model, const Tissue& tissue, Path& depth, double compliance) const {
  if (run.test != Test::indentation) {
    Row row({Spring{}}, tissue, scale_, false);
    Path stress(depth.size());
    for (std::size_t i = 0; i < depth.size(); ++i)
      stress[i] = row.advance(nominal_stress(run.test, depth[i], *tissue.law, tissue.parameters, tissue.stiffening), step_s(run, i));
    return stress;
  }
  if (set_->specimen.shape == "tube") return clamped_force(run, model, tissue, depth, compliance);
  const Site place = site(run);
  const double deepest = std::max(*std::max_element(depth.begin(), depth.end()), 1e-6) * 1.001;
  std::vector<double> depths, forces;
  const auto own = model.tool_form.find(run.tool);
  const std::array<double, 2> of_tool = own == model.tool_form.end() ? std::array<double, 2>{0, 0} : own->second;
  const SiteCurve* solved = correction(run);
  for (int i = 0; i <= springs; ++i) {
    depths.push_back(deepest * std::pow(static_cast<double>(i) / springs, 1.4));
    const double x = depths.back() / scale_;
    forces.push_back((1 + of_tool[0] + of_tool[1] * (2 * x - 1)) * elastic(run, place, tissue, depths.back()) * (1 + model.form[0] * (2 * x - 1) + model.form[1] * (6 * x * x - 6 * x + 1)));
  }
  if (solved && model.mesh_form != 0)
    for (int i = 0; i <= springs; ++i) forces[i] *= std::exp(model.mesh_form * mesh_change(*solved, depths[i]));
  auto list = springs_of(depths, forces);
  if (tissue.adhesion_J_per_m2 > 0) add_adhesion(list, depths, place, tissue);
  Row row(std::move(list), tissue, scale_, true, solved ? solved->memory_mm : 0);
  const double in_series = compliance + tissue.support_mm_per_N;
  Path force = row_forces(run, row, depth, in_series);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] -= in_series * force[i];
  add_friction(place, tissue, depth, force);
  return force;
}

Forward::Pressed Forward::pressed(std::size_t r, const Model& model) const {
  const Run& run = set_->runs[r];
  const Tissue tissue = tissue_at(run, model);
  Pressed p{run.u, {}};
  double compliance = model.compliance_mm_per_N, zero = 0;
  if (run.zero == "tool_start") zero = -model.zero_mm;
  if (run.zero_force_N > 0) {
    const Site place = site(run);
    zero = depth_of_force(run.zero_force_N, scale_, [&](double d) { return elastic(run, place, tissue, d); });
  }
  if (run.test == Test::indentation)
    for (double& d : p.depth_mm) d += zero + model.form[2] * scale_;
  for (const Active& a : model.active) {
    if (a.effect->depth && run.test == Test::indentation) a.effect->depth(run, a.amplitude, a.shape, p.depth_mm);
    if (a.effect->compliance) compliance += a.effect->compliance(a.amplitude);
  }
  p.force_N.assign(p.depth_mm.size(), 0.0);
  if (!run.is_air()) p.force_N = tissue_force(run, model, tissue, p.depth_mm, compliance);
  add_rate(run, tissue, p.depth_mm, run.test == Test::indentation ? scale_ : 1, p.force_N);
  return p;
}

Path Forward::pressed_along(std::size_t r, const Model& model, Path depth) const {
  Tissue tissue = tissue_at(set_->runs[r], model);
  tissue.support_mm_per_N = 0;
  Path force = tissue_force(set_->runs[r], model, tissue, depth, 0);
  add_rate(set_->runs[r], tissue, depth, scale_, force);
  return force;
}

std::vector<double> Forward::force(std::size_t r, const Model& model) const {
  ++evaluations_;
  Path force = pressed(r, model).force_N;
  for (const Active& a : model.active)
    if (a.effect->force) a.effect->force(set_->runs[r], a.amplitude, a.shape, force);
  for (double& F : force) F *= 1 + model.gain;
  return force;
}

}  // namespace palpate::loop
