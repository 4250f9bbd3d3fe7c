// Writes a case per site, runs palpate-solve, and keeps the smooth factor between its force and the closed form.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/solved_curves.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <sstream>

#include <palpate/errors.hpp>
#include <palpate/settings.hpp>
#include <palpate/text_file.hpp>
#include <loop/forward/process.hpp>
#include <loop/forward/shape_mesh.hpp>
#include <loop/methods/session.hpp>
#include <loop/methods/thresholds.hpp>
#include <loop/set/csv.hpp>

namespace palpate::loop {
namespace {

namespace fs = std::filesystem;

/// The case without the tables that the loop writes itself.
std::string without_tools_and_steps(const std::string& text) {
  std::istringstream in(text);
  std::string kept;
  bool keep = true;
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find_first_not_of(" \t");
    if (first != std::string::npos && line[first] == '[') keep = line.find("tool") == std::string::npos && line.find("steps") == std::string::npos;
    if (keep) kept += line + "\n";
  }
  return kept;
}

std::string case_of_shape(const Set& set) {
  const Model start = start_model(set, set.specimen.law == "unknown" ? "neo_hookean" : set.specimen.law);
  std::ostringstream out;
  out.precision(12);
  out << "schema = \"palpate-case/1\"\n[material]\nlaw = \"" << start.law->name << "\"\n";
  for (std::size_t i = 0; i < start.parameters.size(); ++i) out << start.law->parameters[i].name << " = " << start.parameters[i] << "\n";
  if (start.law->name.starts_with("hooke")) out << "nu = 0.5\n";
  out << "[base]\nlabel = \"base\"\n";
  return out.str();
}

std::string tool_table(const Tool& tool, const Run& run, double depth) {
  std::ostringstream out;
  out.precision(12);
  out << "[tool]\nkind = \"" << tool.kind << "\"\nradius_mm = " << tool.radius_mm << "\naim_mm = [" << run.point_mm[0] << ", " << run.point_mm[1] << ", "
      << run.point_mm[2] << "]\naxis = [" << run.axis[0] << ", " << run.axis[1] << ", " << run.axis[2] << "]\ndepth_mm = " << depth
      << "\n[steps]\ncount = 14\nkeep_partial = true\nframes = 1\n";
  return out.str();
}

/// Force over depth as a solve gave it.
struct SolvedCurve {
  std::vector<double> depth_mm, force_N;
  double at(double depth) const {  // relative to the power of the first point below it
    const std::size_t i = std::upper_bound(depth_mm.begin(), depth_mm.end(), depth) - depth_mm.begin();
    if (i == 0) return force_N.front() * std::pow(depth / depth_mm.front(), 1.5);
    if (i == depth_mm.size()) return force_N.back() * std::pow(depth / depth_mm.back(), 1.5);
    const double t = (depth - depth_mm[i - 1]) / (depth_mm[i] - depth_mm[i - 1]);
    const auto bent = [&](std::size_t k) { return force_N[k] / std::pow(depth_mm[k], 1.5); };
    return ((1 - t) * bent(i - 1) + t * bent(i)) * std::pow(depth, 1.5);
  }
};

/// A site to be solved, and where.
struct Job {
  const Set* set;
  const Run* run;
  double deepest_mm;
  std::filesystem::path solver, folder;
  int threads;
};

SolvedCurve solved(const Job& job, const std::string& name, const std::string& material, const fs::path& mesh) {
  const fs::path folder = job.folder / name, the_case = folder / "case.toml", log = folder / "log.txt";
  fs::create_directories(folder);
  write_text(the_case, material + tool_table(job.set->tools.at(job.run->tool), *job.run, job.deepest_mm));
  const int code = run_logged(job.solver, {the_case.string(), (folder / "result").string(), "--mesh", mesh.string(), "--quiet", "--threads=" + std::to_string(job.threads)}, log);
  if (code != 0) throw Failure(ExitCode::not_converged, "the solver fails for tool " + job.run->tool + ": " + read_text(log), job.set->file.string(), "--forward closed");
  const CsvTable history = read_csv(folder / "result" / "history.csv");
  SolvedCurve curve;
  const auto depth = history.numbers("depth", "mm"), force = history.numbers("F", "N");
  for (std::size_t i = 0; i < depth.size(); ++i)
    if (depth[i] > 0 && force[i] > 0) {
      curve.depth_mm.push_back(depth[i]);
      curve.force_N.push_back(force[i]);
    }
  if (curve.depth_mm.size() < 4 || !(curve.depth_mm.back() >= 0.6 * job.deepest_mm))
    throw Failure(ExitCode::not_converged, "the solver reaches too little depth with tool " + job.run->tool, job.set->file.string(), "--forward closed");
  return curve;
}

/// The case's own mesh: solved as it is.
SolvedCurve solved_case(const Job& job) {
  const fs::path& file = job.set->specimen.case_file;
  return solved(job, "case", without_tools_and_steps(read_text(file)), file.parent_path() / Settings::read(file).text("mesh", "mesh.vtu"));
}

/// A shape: the force on its mesh over that on the same mesh with its sides far away, times the closed form, of which a layer's force is known
/// better than from a mesh of this size. A flat punch has no closed form at depth: its own force, times what the mesh misses of the closed form at first contact.
SolvedCurve solved_shape(const Job& job, const Site& site, const Tissue& start, SiteCurve& curve) {
  const Specimen& specimen = job.set->specimen;
  const double R = site.tool.radius_mm, contact = std::min(std::sqrt(R * job.deepest_mm), R);
  const std::string material = case_of_shape(*job.set);
  const auto on = [&](const char* name, double wide) {
    const TetMesh mesh = shape_mesh(specimen, job.run->point_mm, 0.4 * contact, wide);
    curve.nodes = std::max(curve.nodes, static_cast<int>(mesh.points.size()));
    const fs::path file = job.folder / (std::string(name) + ".vtu");
    write_mesh(file, mesh);
    return solved(job, name, material, file);
  };
  SolvedCurve own = on("own", 0);
  const SolvedCurve layer = on("layer", thresholds::wide_layer * specimen.size_mm[2]);
  const bool flat = site.tool.kind.starts_with("flat");
  const double first = own.depth_mm.front();
  for (std::size_t i = 0; i < own.depth_mm.size(); ++i) {
    const double at = flat ? first : own.depth_mm[i];
    own.force_N[i] *= elastic_force(site, start, at) / layer.at(at);
  }
  return own;
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

std::vector<SiteCurve> solved_curves(const Set& set, const fs::path& solver, const fs::path& scratch, int threads,
                                     const std::function<void(const std::string&)>& remark) {
  const Forward forward(set);
  const Tissue start = tissue_of(start_model(set, set.specimen.law == "unknown" ? "neo_hookean" : set.specimen.law));
  std::vector<SiteCurve> curves;
  for (const Run& run : set.runs) {
    if (run.test != Test::indentation || run.is_air() || run.is_block()) continue;
    if (std::any_of(curves.begin(), curves.end(), [&](const SiteCurve& c) { return c.tool == run.tool && norm(c.point_mm - run.point_mm) < 1e-6; })) continue;
    SiteCurve curve{run.tool, run.point_mm};
    double deepest = 0;
    for (const Run& other : set.runs)
      if (other.tool == run.tool && norm(other.point_mm - run.point_mm) < 1e-6 && !other.is_air() && !other.is_block())
        deepest = std::max(deepest, *std::max_element(other.u.begin(), other.u.end()));
    curve.deepest_mm = 1.02 * deepest;
    remark("solving " + set.tools.at(run.tool).kind + " at site " + std::to_string(curves.size() + 1));
    const Job job{&set, &run, curve.deepest_mm, solver, scratch / ("site" + std::to_string(curves.size() + 1)), threads};
    fs::create_directories(job.folder);
    const Site site = forward.site(run);
    fit_factor(site, start, set.specimen.case_file.empty() ? solved_shape(job, site, start, curve) : solved_case(job), curve);
    curves.push_back(curve);
  }
  return curves;
}

}  // namespace palpate::loop
