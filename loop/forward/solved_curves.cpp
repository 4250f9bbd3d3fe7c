// A shape's meshes or a case per site, and the smooth factor between the solver's force and the closed form.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/solved_curves.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <sstream>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <loop/forward/case_curve.hpp>
#include <loop/forward/departures.hpp>
#include <loop/forward/register.hpp>
#include <loop/forward/shape_mesh.hpp>
#include <loop/methods/session.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {
namespace {

namespace fs = std::filesystem;

/// A shape: the force on its mesh over that on the same mesh with its sides far away, times the closed form, of which a layer's force is known
/// better than from a mesh of this size. A flat punch has no closed form at depth: its own force, times what the mesh misses of the closed form at first contact.
SolvedCurve solved_shape(const SiteJob& job, const Site& site, const Tissue& start, SiteCurve& curve) {
  const Specimen& specimen = job.set->specimen;
  const double R = site.tool.radius_mm, contact = std::min(std::sqrt(R * job.deepest_mm), R);
  const std::string material = "schema = \"palpate-case/1\"\n" + material_text(start) + "[base]\nlabel = \"base\"\n";
  const auto on = [&](const char* name, double wide) {
    const TetMesh mesh = shape_mesh(specimen, job.run->point_mm, 0.4 * contact, wide);
    curve.nodes = std::max(curve.nodes, static_cast<int>(mesh.points.size()));
    const fs::path file = job.kept / (std::string(name) + ".vtu");
    write_mesh(file, mesh);
    ++curve.solves;
    return solved(job, material, file);
  };
  SolvedCurve own = on("own", 0);
  const SolvedCurve layer = on("layer", thresholds::wide_layer * specimen.size_mm[2]);
  const bool flat = site.tool.is_flat();
  const double first = own.depth_mm.front();
  for (std::size_t i = 0; i < own.depth_mm.size(); ++i) {
    const double at = flat ? first : own.depth_mm[i];
    own.force_N[i] *= elastic_force(site, start, at) / layer.at(at);
  }
  return own;
}

/// A folder of their own for the meshes of a specimen, tool and place, so that runs on other specimens may share what is kept.
std::string place_name(const Set& set, const Run& run, double deepest) {
  std::ostringstream all;
  all.precision(12);
  const Specimen& s = set.specimen;
  all << s.shape << s.size_mm[0] << " " << s.size_mm[1] << " " << s.size_mm[2] << " " << (s.case_file.empty() ? "" : sha256(mesh_of_case(s.case_file)));
  for (int i = 0; i < 3; ++i) all << " " << run.point_mm[i] << " " << run.axis[i];
  all << " " << set.tools.at(run.tool).kind << " " << set.tools.at(run.tool).radius_mm << " " << deepest;
  return "place-" + sha256_of_bytes(all.str()).substr(0, 12);
}

/// Depths at which the catalogue asks for an inclusion under this place.
std::vector<double> inclusions_under(const Set& set, const Vec3& point) {
  std::vector<double> depths;
  for (const Effect& effect : all_effects())
    if (effect.entry.name == "inclusion")
      for (const auto& shape : effect.grid_of(set))
        if (norm(Vec3{shape[0], shape[1], shape[2]} - point) < 0.5) depths.push_back(shape[3]);
  return depths;
}

/// Least squares of solved over closed force, weighted by the force.
void fit_factor(const Site& site, const Tissue& start, const SolvedCurve& solved, SiteCurve& curve) {
  const int n = static_cast<int>(solved.depth_mm.size());
  Eigen::MatrixXd A(n, 3);
  const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(solved.force_N.data(), n);
  for (int i = 0; i < n; ++i) {
    const double closed = elastic_force(site, start, solved.depth_mm[i]), x = solved.depth_mm[i] / curve.deepest_mm;
    A.row(i) << closed, closed * x, closed * x * x;
  }
  const Eigen::Vector3d c = A.colPivHouseholderQr().solve(b);
  curve.factor = {c(0), c(1), c(2)};
  curve.scatter = (A * c - b).norm() / b.norm();
}

}  // namespace

bool is_wide_layer(const Set& set) {
  const Specimen& s = set.specimen;
  if (!s.case_file.empty() || !s.bonded || s.ring || (s.shape != "block" && s.shape != "cylinder")) return false;
  return std::all_of(set.runs.begin(), set.runs.end(), [&](const Run& run) {
    if (run.test != Test::indentation || run.is_air() || run.is_block()) return true;
    const double x = std::abs(run.point_mm[0]), y = std::abs(run.point_mm[1]);
    const double to_side = s.shape == "cylinder" ? s.size_mm[0] / 2 - std::hypot(x, y) : std::min(s.size_mm[0] / 2 - x, s.size_mm[1] / 2 - y);
    return set.tools.at(run.tool).kind == "ball" && to_side >= thresholds::wide_layer * s.size_mm[2];
  });
}

bool can_be_solved(const Set& set) {
  if (!set.specimen.case_file.empty()) return true;
  return set.specimen.bonded && !set.specimen.ring && (set.specimen.shape == "block" || set.specimen.shape == "cylinder") && set.specimen.size_mm[0] < 1e3;
}

std::vector<SiteCurve> solved_curves(const Set& set, const fs::path& solver, const fs::path& kept, int threads, const std::function<void(const std::string&)>& remark) {
  const Forward forward(set);
  const bool law_unknown = set.specimen.law == "unknown", is_case = !set.specimen.case_file.empty();
  const Tissue start = tissue_of(start_model(set, law_unknown ? "neo_hookean" : set.specimen.law));
  std::vector<SiteCurve> curves;
  for (const Run& run : set.runs) {
    if (run.test != Test::indentation || run.is_air() || run.is_block()) continue;
    if (std::any_of(curves.begin(), curves.end(), [&](const SiteCurve& c) { return c.tool == run.tool && norm(c.point_mm - run.point_mm) < 1e-6; })) continue;
    SiteCurve curve;
    curve.tool = run.tool;
    curve.point_mm = run.point_mm;
    double deepest = 0;
    for (const Run& other : set.runs)
      if (other.tool == run.tool && norm(other.point_mm - run.point_mm) < 1e-6 && !other.is_air() && !other.is_block())
        deepest = std::max(deepest, *std::max_element(other.u.begin(), other.u.end()));
    curve.deepest_mm = 1.02 * deepest;
    remark("solving " + set.tools.at(run.tool).kind + " at site " + std::to_string(curves.size() + 1));
    const SiteJob job{&set, &run, curve.deepest_mm, solver, kept / place_name(set, run, curve.deepest_mm)};
    fs::create_directories(job.kept);
    const Site site = forward.site(run);
    if (is_case)
      fit_factor(site, base_of_case(set, start), solve_case(job, site, start, law_unknown || start.law->name == "neo_hookean", inclusions_under(set, run.point_mm), threads, curve), curve);
    else
      fit_factor(site, start, solved_shape(job, site, start, curve), curve);
    curves.push_back(curve);
  }
  return curves;
}

void tell_mesh_errors(const std::vector<SiteCurve>& curves, Set& set) {
  double apart = 0, least = 0, most = 0;
  for (const SiteCurve& c : curves) {
    apart = std::max(apart, c.mesh_apart);
    least = std::min(&c == &curves.front() ? c.mesh_shift : least, c.mesh_shift);
    most = std::max(&c == &curves.front() ? c.mesh_shift : most, c.mesh_shift);
  }
  if (!(apart > 0)) return;
  set.mesh_sd = 0.5;
  set.mesh_apart = apart;
  set.curve_sd = std::max(thresholds::form_sd, 0.2 * apart);
  set.tool_curve_sd = std::max(thresholds::form_tool_sd, 0.2 * apart);
  set.tool_size_sd = std::max(thresholds::form_sd, 0.2 * (most - least));
}

}  // namespace palpate::loop
