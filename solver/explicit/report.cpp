// Rows, frames, summary and checks of a closing.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/report.hpp>

#include <algorithm>
#include <iomanip>
#include <numeric>
#include <sstream>

#include <palpate/text_file.hpp>
#include <solver/explicit/closing.hpp>
#include <solver/explicit/jaws_mesh.hpp>
#include <solver/explicit/stress_works.hpp>
#include <solver/restart.hpp>

namespace palpate::explicit_shell {
namespace {

constexpr double jaw_edge = 2;  ///< mm, of the hexahedra that show the jaws

struct Report {
  Closing& closing;
  std::filesystem::path folder;
  std::string history, frames;
  int frame_count = 0, crossing_pairs = 0;
  double peak_force = 0, last_force = 0, farthest = 0;
  Row last;
  std::vector<std::string> files;  ///< frames written
  StressWorks works;

  explicit Report(Closing& closing_, std::filesystem::path folder_)
      : closing(closing_), folder(std::move(folder_)), works(closing.c.works, closing.jaws.start_gap() - closing.c.clamp.gap) {
    std::filesystem::create_directories(folder / "frames");
    history = "t[s],depth[mm],Fx[N],Fy[N],Fz[N],F[N],contact_area[mm2],iterations,gap[mm],self_area[mm2],step[s],kinetic[mJ],internal[mJ],contact[mJ],damping[mJ],external[mJ]\n";
  }

  void add(const Row& r) {
    std::ostringstream line;
    line << std::setprecision(12);
    for (double v : {r.time, r.travel, r.force.x(), r.force.y(), r.force.z(), r.closing_force, r.jaw_area}) line << (v == 0 ? 0.0 : v) << ',';
    line << r.cycles;
    for (double v : {r.gap, r.self_area, r.step, r.ledger.kinetic, r.ledger.internal, r.ledger.contact, r.ledger.damping, r.ledger.external}) line << ',' << (v == 0 ? 0.0 : v);
    history += line.str() + "\n";
    peak_force = std::max(peak_force, r.closing_force);
    last_force = r.closing_force;
    farthest = std::max(farthest, r.travel);
    works.look(closing.c.wall, closing.motion.state, r.travel);
    last = r;
  }

  void keep(Archive& a) { a(closing, history, frames, frame_count, crossing_pairs, peak_force, last_force, farthest, last, files, works); }

  void write_frame(const Row& r) {
    const Wall& wall = closing.c.wall;
    Field displacement{"displacement", 3, {}}, pressure{"contact_pressure", 1, closing.contact_pressure()};
    for (std::size_t i = 0; i < wall.rest.size(); ++i)
      for (int k = 0; k < 3; ++k) displacement.values.push_back(closing.motion.state.x[i][k] - wall.rest[i][k]);
    Field von_mises{"von_mises", 1, {}}, strain{"strain", 1, {}}, thickness{"thickness_now", 1, {}};
    for (const auto& s : triangle_states(wall, closing.motion.state, closing.effects_on_stress())) {
      von_mises.values.push_back(s.von_mises);
      strain.values.push_back(s.strain);
      thickness.values.push_back(s.thickness);
    }
    std::ostringstream name;
    name << "frames/frame_" << std::setw(4) << std::setfill('0') << frame_count++ << ".vtu";
    write_shells(folder / name.str(), closing.c.mesh, {displacement, pressure}, {von_mises, strain, thickness});
    files.push_back(name.str());
    std::ostringstream entry;
    entry << "    <DataSet timestep=\"" << r.time << "\" file=\"" << name.str() << "\"/>\n";
    frames += entry.str();
    crossing_pairs += crossings(wall, closing.motion.state.x);
  }

  Json summary() const {
    const Wall& wall = closing.c.wall;
    const auto states = triangle_states(wall, closing.motion.state, closing.effects_on_stress());
    const auto most = [&](double TriangleState::*value) { return area_quantile(wall, states, value, 1); };
    double mass = 0, touched = 0, peak_pressure = 0;
    for (double m : wall.mass) mass += m;
    const auto pressure = closing.contact_pressure();
    for (int i : closing.jaws.touched()) peak_pressure = std::max(peak_pressure, pressure[i]), touched += 1;
    Json s = closing.c.law;
    s["scheme"] = "explicit";
    s["thickness_mm"] = {*std::min_element(wall.thickness.begin(), wall.thickness.end()), *std::max_element(wall.thickness.begin(), wall.thickness.end())};
    s["clamp"] = {{"start_gap_mm", closing.jaws.start_gap()}, {"stop_gap_mm", closing.c.clamp.gap}, {"width_mm", closing.c.clamp.width}, {"length_mm", closing.c.clamp.length},
                  {"friction", closing.c.clamp.friction()}, {"drive", closing.c.clamp.pressure ? "pressure" : "motion"}};
    s["depth_mm"] = {{"asked", closing.jaws.start_gap() - closing.c.clamp.gap}, {"reached", farthest}};
    s["peak_force_N"] = peak_force;
    s["last_force_N"] = last_force;
    s["max_von_mises_MPa"] = most(&TriangleState::von_mises);
    s["von_mises_995_MPa"] = area_quantile(wall, states, &TriangleState::von_mises, 0.995);
    s["max_strain"] = most(&TriangleState::strain);
    s["strain_995"] = area_quantile(wall, states, &TriangleState::strain, 0.995);
    s["contact_pressure_MPa"] = {{"mean", last.jaw_area > 0 ? last_force / last.jaw_area : 0}, {"peak", peak_pressure}};
    s["contact_area_mm2"] = last.jaw_area;
    s["self_contact_area_mm2"] = last.self_area;
    s["nodes"] = wall.rest.size();
    s["triangles"] = wall.triangles.size();
    s["cycles"] = closing.cycles;
    s["mass_g"] = mass * 1e6;
    s["added_mass_part"] = wall.added_mass / mass;
    s["energy_imbalance_part"] = closing.worst_imbalance / closing.peak_internal;
    s["kinetic_part"] = closing.worst_kinetic;
    s["jaw_penetration_mm"] = closing.jaws.deepest();
    s["self_penetration_mm"] = closing.self.deepest();
    s["crossing_triangle_pairs"] = crossing_pairs;
    return s;
  }

  void write_jaws() const {
    Surface jaws;
    for (const auto& x : closing.jaws.corners()) jaws.points.push_back({x.x(), x.y(), x.z()});
    for (int j : {0, 8})
      for (const auto& [a, b, c, d] : {std::array{0, 1, 3, 2}, std::array{4, 6, 7, 5}, std::array{0, 4, 5, 1}, std::array{2, 3, 7, 6}, std::array{0, 2, 6, 4}, std::array{1, 5, 7, 3}}) {
        jaws.triangles.push_back({j + a, j + c, j + b});
        jaws.triangles.push_back({j + a, j + d, j + c});
      }
    jaws.triangle_region.assign(jaws.triangles.size(), 1);
    jaws.region_names = {{1, "jaw"}};
    write_surface(folder / "jaws.vtp", jaws);
    write_text(folder / "jaws.vtu", blocks_as_vtu(closing.jaws.corners(), jaw_edge, closing.c.clamp.mass));
  }

  Json finish() {
    write_text(folder / "history.csv", history);
    write_text(folder / "frames.pvd", "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n" + frames + "  </Collection>\n</VTKFile>\n");
    if (closing.c.works > 0) write_text(folder / "stress_works.csv", works.csv());
    write_jaws();
    const Json facts = summary();
    write_text(folder / "summary.json", facts.dump(2) + "\n");
    return facts;
  }
};

}  // namespace

bool is_explicit(const std::filesystem::path& path) {
  const Settings settings = Settings::read(path);
  return settings.has("scheme") && settings.choice("scheme", {"implicit", "explicit"}) == "explicit";
}

void solve(Command& command) {
  Case c = read_case(command.input("case"), command.has("mesh") ? command.file("mesh") : "");
  if (!command.has("mesh")) command.add_input("mesh", c.mesh_path);
  constexpr double most_added_mass = 0.05;
  if (const double all = std::accumulate(c.wall.mass.begin(), c.wall.mass.end(), 0.0), part = c.wall.added_mass / all; part > most_added_mass) {
    std::ostringstream text;
    text << "added mass would be " << 100 * part << " % of the wall's, where " << 100 * most_added_mass << " % are allowed";
    throw Failure(ExitCode::check_failed, text.str(), command.input("case").string(), "a smaller [steps] least_step_s");
  }
  Closing closing(c, command.threads());
  command.say(std::to_string(c.wall.rest.size()) + " nodes, " + std::to_string(c.wall.triangles.size()) + " triangles, jaws " + std::to_string(closing.jaws.start_gap()) + " mm apart");
  Restart restart(command, command.output("result"));
  const auto left = restart.read();
  Report report(closing, command.output("result"));
  if (left) {
    Archive archive(*left);
    report.keep(archive);
    command.say("continues a run that was killed, at gap " + std::to_string(closing.jaws.gap()) + " mm");
  }
  Progress progress = command.progress("solve", c.rows);
  int rows = 0;
  try {
    closing.run([&](const Row& r) {
      report.add(r);
      std::ostringstream remark;
      remark << std::setprecision(3) << "gap " << r.gap << " mm, force " << r.closing_force << " N";
      progress.update(rows++, remark.str());
    }, [&](const Row& r) { report.write_frame(r); }, [&] {
      restart.write([&] {
        Archive archive;
        report.keep(archive);
        return archive.bytes();
      }, report.files);
    });
  } catch (const Failure& failure) {
    const Row now = closing.row_of(closing.jaws.force_on_wall());
    if (failure.code() != ExitCode::not_converged || !c.keep_partial || !std::isfinite(now.ledger.kinetic + now.ledger.internal)) throw;
    command.warn(failure.what());
    report.add(now);
    report.write_frame(now);
  }
  progress.finish();
  if (const double asked = closing.jaws.start_gap() - c.clamp.gap; report.farthest < 0.999 * asked) {
    std::ostringstream text;
    text << "the jaws closed by " << report.farthest << " mm of " << asked << " mm: "
         << (c.clamp.pressure ? "the pressure closes them no further, or [steps] duration_s is too short" : "[steps] duration_s, or what is told above, ends it before");
    command.warn(text.str());
  }
  restart.remove();
  const Json summary = report.finish();
  command.note("summary", summary);
  command.check(check_at_most("energy balance of the largest internal energy", closing.worst_imbalance / closing.peak_internal, 0.01));
  command.check(check_at_most("added mass", c.wall.added_mass > 0 ? summary.at("added_mass_part").get<double>() : 0, most_added_mass));
  if (c.kinetic_part > 0) command.check(check_at_most("wall's kinetic over internal energy after a tenth of the closing", closing.worst_kinetic, c.kinetic_part));
  command.check(check_equal("triangles that cross", report.crossing_pairs, 0));
  std::ostringstream line;
  line << "peak force " << report.peak_force << " N, " << summary.at("max_von_mises_MPa").get<double>() << " MPa at gap " << closing.jaws.gap() << " mm";
  command.print(line.str());
}

}  // namespace palpate::explicit_shell
