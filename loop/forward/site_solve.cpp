// The case, the process and its history; a finished solve is kept under the hash of all that went into it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/site_solve.hpp>

#include <cmath>
#include <sstream>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <palpate/text_file.hpp>
#include <loop/forward/process.hpp>
#include <loop/set/csv.hpp>

namespace palpate::loop {
namespace {

namespace fs = std::filesystem;

std::string tool_text(const Tool& tool, const Run& run) {
  std::ostringstream out;
  out.precision(12);
  out << "[tool]\nkind = \"" << tool.kind << "\"\nradius_mm = " << tool.radius_mm << "\naim_mm = [" << run.point_mm[0] << ", " << run.point_mm[1] << ", "
      << run.point_mm[2] << "]\naxis = [" << run.axis[0] << ", " << run.axis[1] << ", " << run.axis[2] << "]\n";
  return out.str();
}

}  // namespace

double SolvedCurve::at(double depth) const {
  const std::size_t i = std::upper_bound(depth_mm.begin(), depth_mm.end(), depth) - depth_mm.begin();
  if (i == 0) return force_N.front() * std::pow(depth / depth_mm.front(), 1.5);
  if (i == depth_mm.size()) return force_N.back() * std::pow(depth / depth_mm.back(), 1.5);
  const double t = (depth - depth_mm[i - 1]) / (depth_mm[i] - depth_mm[i - 1]);
  const auto bent = [&](std::size_t k) { return force_N[k] / std::pow(depth_mm[k], 1.5); };
  return ((1 - t) * bent(i - 1) + t * bent(i)) * std::pow(depth, 1.5);
}

SolvedMotion solved_case(const std::string& text, const fs::path& mesh, const fs::path& solver, const fs::path& kept) {
  const fs::path folder = kept / sha256_of_bytes(text + sha256(mesh) + sha256(solver)).substr(0, 16), result = folder / "result", log = folder / "log.txt";
  fs::create_directories(folder);
  const FolderLock lock(folder);
  if (!fs::exists(result / "history.csv")) {
    write_text(folder / "case.toml", text);
    const int code = run_logged(solver, {(folder / "case.toml").string(), result.string(), "--mesh", mesh.string(), "--quiet", "--threads=1"}, log);
    if (code != 0) throw Failure(ExitCode::not_converged, read_text(log));
  }
  const CsvTable history = read_csv(result / "history.csv");
  return {history.numbers("t", "s"), history.numbers("depth", "mm"), history.numbers("F", "N")};
}

SolvedCurve curve_of(const SolvedMotion& motion) {
  SolvedCurve curve;
  for (std::size_t i = 0; i < motion.depth_mm.size(); ++i)
    if (motion.depth_mm[i] > 0 && motion.force_N[i] > 0) {
      curve.depth_mm.push_back(motion.depth_mm[i]);
      curve.force_N.push_back(motion.force_N[i]);
    }
  return curve;
}

SolvedMotion solved_motion(const SiteJob& job, const std::string& text, const std::string& motion, const fs::path& mesh) {
  try {
    return solved_case(text + tool_text(job.set->tools.at(job.run->tool), *job.run) + motion, mesh, job.solver, job.kept);
  } catch (const Failure& failure) {
    throw Failure(ExitCode::not_converged, "the solver fails for tool " + job.run->tool + ": " + failure.what(), job.set->file.string(), "--forward closed");
  }
}

SolvedCurve solved(const SiteJob& job, const std::string& text, const fs::path& mesh, int steps) {
  std::ostringstream motion;
  motion.precision(12);
  motion << "depth_mm = " << job.deepest_mm << "\n[steps]\ncount = " << steps << "\nkeep_partial = true\nframes = 1\n";
  const SolvedCurve curve = curve_of(solved_motion(job, text, motion.str(), mesh));
  if (curve.depth_mm.size() < 4 || !(curve.depth_mm.back() >= 0.6 * job.deepest_mm))
    throw Failure(ExitCode::not_converged, "the solver reaches too little depth with tool " + job.run->tool, job.set->file.string(), "--forward closed");
  return curve;
}

}  // namespace palpate::loop
