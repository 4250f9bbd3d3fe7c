// The wall, the case, the run.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/clamp_closing.hpp>

#include <algorithm>
#include <sstream>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/text_file.hpp>
#include <loop/forward/process.hpp>

namespace palpate::loop {
namespace {

namespace fs = std::filesystem;

void run_program(const fs::path& program, const std::vector<std::string>& words, const fs::path& log) {
  if (run_logged(program, words, log) != 0) throw Failure(ExitCode::not_converged, program.filename().string() + " fails for the clamp: " + read_text(log), log.string());
}

std::string number(double x) {
  std::ostringstream out;
  out.precision(9);
  out << x;
  return out.str();
}

/// A fold is at the end about as sharp as the wall is thick, and forces hang on its edges until they are 0.36 of that (decision 054). Finer on finer meshes.
double fold_edge(const Specimen& s, const Closing& job) {
  return std::min(job.edge_mm / 2, (job.fine_folds ? 0.36 : 1) * s.wall_mm * std::min(1.0, job.edge_mm / s.edge_mm));
}

/// What is solved, in words that also name it: everything a result hangs on.
std::string case_text(const Bench& b, const Run& run, const Closing& job) {
  const Tool& jaws = b.set.tools.at(run.tool);
  const Specimen& s = b.set.specimen;
  std::ostringstream out;
  out.precision(9);
  out << "# tube " << s.size_mm[0] << " x " << s.size_mm[2] << " mm, wall " << s.wall_mm << " mm, edges " << job.edge_mm << " mm, in the folds " << fold_edge(s, job) << " mm";
  if (job.excess != 0) out << ", from " << job.from << " to " << job.to << " mm " << 1 + job.excess << " times as thick";
  out << "; solver " << b.version << "\nschema = \"palpate-case/1\"\nscheme = \"explicit\"\n";
  if (s.ends != "section") out << "ends = \"" << s.ends << "\"\n";
  out << "[material]\nlaw = \"" << b.start.law->name << "\"\n";
  for (std::size_t i = 0; i < b.start.parameters.size(); ++i)
    out << b.start.law->parameters[i].name << " = " << b.start.parameters[i] * (static_cast<int>(i) == job.parameter ? 1.5 : 1) << "\n";
  out << "[clamp]\ncentre_mm = [" << run.point_mm[0] << ", " << run.point_mm[1] << ", " << run.point_mm[2] << "]\naxis = [" << run.axis[0] << ", " << run.axis[1] << ", " << run.axis[2]
      << "]\nwidth_mm = " << jaws.width_mm << "\nlength_mm = " << jaws.length_mm << "\nspeed_mm_s = " << job.speed_mm_s << "\nopens = true\nhold_s = 0.06\nopen_mm = " << s.size_mm[0] + ahead_mm
      << "\ngap_mm = " << b.stop_gap_mm() << "\nangle_deg = " << job.angle_deg << "\n";
  if (job.friction > 0) out << "friction = " << job.friction << "\nself_friction = " << job.friction << "\n";
  out << "[steps]\nframes = 1\nrows = 240\nkinetic_part = 0.05\n" << (job.works ? "stress_works = 80\n" : "");
  return out.str();
}

fs::path wall_file(const Bench& b, const Run& run, const Closing& job, const fs::path& folder) {
  const Specimen& s = b.set.specimen;
  const fs::path tube = folder / "tube.vtp", wall = folder / "wall.vtu", log = folder / "log.txt";
  run_program(b.tube_program, {tube.string(), "--diameter", number(s.size_mm[0]), "--length", number(s.size_mm[2]), "--edge", "1.5", "--quiet"}, log);
  const std::string at = number(run.point_mm[0]) + "," + number(run.point_mm[1]) + "," + number(run.point_mm[2]);
  const std::string axis = number(run.axis[0]) + "," + number(run.axis[1]) + "," + number(run.axis[2]);
  for (double coarser : {1.4, 1.5, 1.3}) {  // of the edges elsewhere; palpate-mesh refuses what misses its limits
    try {
      run_program(b.mesh_program, {tube.string(), wall.string(), "--kind", "shell", "--thickness", number(s.wall_mm), "--offset", number(-s.wall_mm / 2), "--edge",
                                   number(coarser * job.edge_mm), "--focus=" + at, "--focus-edge", number(job.edge_mm), "--focus-radius", "10", "--jaws-axis=" + axis, "--fold-edge", number(fold_edge(s, job)), "--quiet"}, log);
      break;
    } catch (const Failure&) {
      if (coarser == 1.3) throw;
    }
  }
  if (job.excess == 0) return wall;
  ShellMesh mesh = read_shells(wall);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)  // half of what changes lies on either side of the slice's end
    mesh.thickness_mm[i] *= 1 + job.excess * std::clamp(std::min(mesh.points[i][2] - job.from, job.to - mesh.points[i][2]) + 0.5, 0.0, 1.0);
  write_shells(wall, mesh);
  return wall;
}

}  // namespace

fs::path closed(const Bench& b, const Run& run, Closing job) {
  const std::string text = case_text(b, run, job);  // asked; the case may be slower
  const fs::path folder = b.kept / sha256_of_bytes(text).substr(0, 16), result = folder / "result";
  if (fs::exists(result / "history.csv") && fs::exists(folder / "asked.toml") && read_text(folder / "asked.toml") == text) return result;
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path wall = wall_file(b, run, job, folder);
  for (double speed : {200.0, 100.0, 50.0}) {
    job.speed_mm_s = speed;
    write_text(folder / "case.toml", case_text(b, run, job));
    try {
      run_program(b.solver, {(folder / "case.toml").string(), result.string(), "--mesh", wall.string(), "--quiet", "--threads=1"}, folder / "log.txt");
      break;
    } catch (const Failure&) {
      if (speed == 50) throw;
    }
  }
  fs::remove_all(result / "frames");
  write_text(folder / "asked.toml", text);
  return result;
}

}  // namespace palpate::loop
