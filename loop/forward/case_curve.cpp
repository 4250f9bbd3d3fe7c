// A case's text with other materials, its mesh refined under the tool, and least squares of solved over closed forms.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/case_curve.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <palpate/errors.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/settings.hpp>
#include <palpate/text_file.hpp>
#include <loop/forward/departures.hpp>
#include <loop/forward/process.hpp>
#include <loop/methods/parallel.hpp>

namespace palpate::loop {
namespace {

namespace fs = std::filesystem;

constexpr double change_share = 0.15;  // of the force: as large as effects are that are looked for
constexpr double followed = 0.1;       // of a solved change that the closed form, scaled, may miss

/// A solve of the case: its material, and the departure that is in it.
struct Variant {
  Tissue tissue;
  const Departure* of = nullptr;
  double amplitude = 0;
  SolvedCurve curve;
};

/// The start without any departure that the solver is asked about.
Tissue without_departures(Tissue tissue) {
  for (const Departure& d : departures())
    if (d.in(tissue)) d.remove(tissue);
  return tissue;
}

std::vector<Variant> variants_of(const Site& site, const Tissue& start, bool law_open, double deepest) {
  const Tissue base = without_departures(start);
  std::vector<Variant> list = {{base, nullptr, 0, {}}};
  for (const Departure& d : departures()) {
    const bool of_null = d.in(start), is_law = d.name != "compressibility" && d.name != "capsule";
    if (is_law && !of_null && !(law_open && base.law->name == "neo_hookean")) continue;
    Variant v{of_null ? start : base, &d, 0, {}};
    if (!of_null) {
      v.amplitude = amplitude_of(d, site, base, deepest, change_share);
      d.add(v.tissue, v.amplitude);
    }
    list.push_back(v);
  }
  return list;
}

/// The mesh with edges half as long where the tool comes: within a contact radius of its axis, and half of one deep.
fs::path refined_mesh(const SiteJob& job, const fs::path& own, double contact) {
  const TetMesh mesh = read_mesh(own);
  const Vec3 axis = (1 / norm(job.run->axis)) * job.run->axis;
  const auto along = [&](const Vec3& p) { return dot(p - job.run->point_mm, axis); };
  const auto aside = [&](const Vec3& p) { return norm(p - job.run->point_mm - along(p) * axis); };
  double first = std::numeric_limits<double>::infinity();
  for (const Vec3& p : mesh.points)
    if (aside(p) < contact) first = std::min(first, along(p));
  std::vector<double> target(mesh.tets.size(), 0), lengths;
  std::vector<std::size_t> near;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 middle{0, 0, 0};
    double longest = 0;
    for (int a : mesh.tets[t]) {
      middle = middle + 0.25 * mesh.points[a];
      for (int b : mesh.tets[t]) longest = std::max(longest, norm(mesh.points[a] - mesh.points[b]));
    }
    if (aside(middle) > contact || along(middle) > first + 0.5 * contact) continue;
    near.push_back(t);
    lengths.push_back(longest);
  }
  if (near.empty()) throw Failure(ExitCode::refused, "the mesh has nothing under tool " + job.run->tool, own.string(), "point_mm and axis of the run");
  std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
  for (std::size_t t : near) target[t] = std::max(0.5 * lengths[lengths.size() / 2], contact / 6);
  const fs::path marked = job.kept / "marked.vtu", finer = job.kept / "finer.vtu", log = job.kept / "remesh.txt";
  write_mesh(marked, mesh, {}, {{"target_mm", 1, target}});
  if (run_logged(beside("palpate-remesh"), {marked.string(), finer.string(), "--quiet", "--force"}, log) != 0)
    throw Failure(ExitCode::not_converged, "the mesh cannot be made finer under tool " + job.run->tool + ": " + read_text(log), own.string(), "--forward closed");
  return finer;
}

/// What a mesh misses falls by a power of its edges, on graded meshes between the first and the second: after halving them at least a third of the change is still
/// missing (Richardson 1911), which is added, and at most all of it.
SolvedCurve extrapolated(SolvedCurve fine, const SolvedCurve& own, SiteCurve& curve) {
  std::vector<double>& ratio = curve.mesh_change;
  for (std::size_t i = 0; i < fine.depth_mm.size(); ++i) ratio.push_back(std::log(fine.force_N[i] / own.at(fine.depth_mm[i])));
  curve.mesh_depth_mm = fine.depth_mm;
  const double n = static_cast<double>(ratio.size());
  for (double r : ratio) curve.mesh_shift += r / n;
  double squares = 0;
  for (double r : ratio) squares += (r - curve.mesh_shift) * (r - curve.mesh_shift) / n;
  curve.mesh_apart = std::sqrt(squares);
  for (std::size_t i = 0; i < ratio.size(); ++i) fine.force_N[i] *= std::exp(ratio[i] / 3);
  return fine;
}

SolvedChange change_of(const Variant& v, const Variant& base, const Site& site, double deepest) {
  const auto n = static_cast<Eigen::Index>(v.curve.depth_mm.size());
  Eigen::MatrixXd A(n, 2);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double depth = v.curve.depth_mm[i], null = elastic_force(site, base.tissue, depth), closed = elastic_force(site, v.tissue, depth) - null;
    A.row(i) << closed, closed * depth / deepest;
    b(i) = null * (v.curve.force_N[i] / base.curve.at(depth) - 1);
  }
  const Eigen::Vector2d q = A.colPivHouseholderQr().solve(b);
  const double scatter = (A * q - b).norm() / std::max(b.norm(), 1e-300);
  if (v.amplitude > 0 && !(scatter <= followed)) return {v.of->name, v.amplitude, {0, 0}, scatter};  // not offered: the closed form says nothing of it here
  return {v.of->name, v.amplitude, {q(0), q(1)}, scatter};
}

}  // namespace

std::string case_without(const std::string& text, const std::vector<std::string>& tables) {
  std::istringstream in(text);
  std::string kept;
  bool keep = true;
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find_first_not_of(" \t");
    if (first != std::string::npos && line[first] == '[')
      keep = std::none_of(tables.begin(), tables.end(), [&](const std::string& name) { return line.find(name) != std::string::npos; });
    if (keep) kept += line + "\n";
  }
  return kept;
}

fs::path mesh_of_case(const fs::path& file) { return file.parent_path() / Settings::read(file).text("mesh", "mesh.vtu"); }

bool has_one_material(const fs::path& case_file) { return Settings::read(case_file).tables("material").size() == 1; }

Tissue base_of_case(const Set& set, const Tissue& start) { return has_one_material(set.specimen.case_file) ? without_departures(start) : start; }

SolvedCurve solve_case(const SiteJob& job, const Site& site, const Tissue& start, bool law_open, int threads, SiteCurve& curve) {
  const fs::path& file = job.set->specimen.case_file;
  const fs::path own = mesh_of_case(file);
  const std::string text = read_text(file);
  fs::create_directories(job.kept);
  const bool one = has_one_material(file);
  const std::string rest = case_without(text, one ? std::vector<std::string>{"material", "tool", "steps"} : std::vector<std::string>{"tool", "steps"});
  auto variants = one ? variants_of(site, start, law_open, job.deepest_mm) : std::vector<Variant>{{start, nullptr, 0, {}}};
  const fs::path finer = refined_mesh(job, own, std::min(std::sqrt(site.tool.radius_mm * job.deepest_mm), site.tool.radius_mm));
  SolvedCurve fine;
  const auto text_of = [&](const Variant& v) { return one ? rest + material_text(v.tissue) : rest; };
  for_each_index(static_cast<int>(variants.size()) + 1, threads, [&](int i) {
    if (i == 0) fine = solved(job, text_of(variants[0]), finer);
    else variants[i - 1].curve = solved(job, text_of(variants[i - 1]), own);
  });
  for (const Variant& v : variants)
    if (v.of) curve.changes.push_back(change_of(v, variants.front(), site, job.deepest_mm));
  curve.solves = static_cast<int>(variants.size()) + 1;
  curve.nodes = static_cast<int>(read_mesh(finer).points.size());
  return extrapolated(fine, variants.front().curve, curve);
}

}  // namespace palpate::loop
