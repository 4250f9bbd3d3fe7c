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

/// Least squares of solved over closed force, weighted by the force.
void fit_factor(const Forward& forward, const Run& run, const Tissue& start, const CsvTable& history, SiteCurve& curve) {
  const auto depth = history.numbers("depth", "mm"), force = history.numbers("F", "N");
  const Site site = forward.site(run);
  std::vector<Eigen::Vector4d> rows;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double closed = elastic_force(site, start, depth[i]), x = depth[i] / curve.deepest_mm;
    if (closed > 0) rows.push_back({closed, closed * x, closed * x * x, force[i]});
  }
  Eigen::MatrixXd A(rows.size(), 3);
  Eigen::VectorXd b(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    A.row(i) = rows[i].head<3>();
    b(i) = rows[i](3);
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
    return set.tools.at(run.tool).kind == "ball" && to_side >= 2.5 * s.size_mm[2];
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
    const Tool& tool = set.tools.at(run.tool);
    const std::string name = "site" + std::to_string(curves.size() + 1);
    const fs::path folder = scratch / name, mesh = folder / "mesh.vtu", log = folder / "log.txt";
    fs::create_directories(folder);
    const bool is_case = !set.specimen.case_file.empty();
    write_text(folder / "case.toml", (is_case ? without_tools_and_steps(read_text(set.specimen.case_file)) : case_of_shape(set)) + tool_table(tool, run, curve.deepest_mm));
    fs::path its_mesh = mesh;
    if (is_case) {
      const Settings the_case = Settings::read(set.specimen.case_file);
      its_mesh = set.specimen.case_file.parent_path() / the_case.text("mesh", "mesh.vtu");
    } else {
      const double contact = std::min(std::sqrt(tool.radius_mm * deepest), tool.radius_mm);
      const TetMesh made = shape_mesh(set.specimen, run.point_mm, 0.4 * contact);
      curve.nodes = static_cast<int>(made.points.size());
      write_mesh(mesh, made);
    }
    remark("solving " + tool.kind + " at site " + std::to_string(curves.size() + 1));
    const int code = run_logged(solver, {(folder / "case.toml").string(), (folder / "result").string(), "--mesh", its_mesh.string(), "--quiet",
                                         "--threads=" + std::to_string(threads)}, log);
    if (code != 0) throw Failure(ExitCode::not_converged, "the solver fails for tool " + run.tool + ": " + read_text(log), set.file.string(), "--forward closed");
    const CsvTable history = read_csv(folder / "result" / "history.csv");
    if (!(history.numbers("depth", "mm").back() >= 0.6 * deepest))
      throw Failure(ExitCode::not_converged, "the solver reaches too little depth with tool " + run.tool, set.file.string(), "--forward closed");
    fit_factor(forward, run, start, history, curve);
    curves.push_back(curve);
  }
  return curves;
}

}  // namespace palpate::loop
