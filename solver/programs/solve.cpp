// palpate-solve: presses an organ with rigid tools.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/text_file.hpp>
#include <solver/explicit/report.hpp>
#include <solver/results.hpp>
#include <solver/sensitivities.hpp>

#include <optional>
#include <sstream>

using namespace palpate;

void usage(Usage& u) {
  u.name = "solve";
  u.sentence = "Presses an organ of tetrahedra with rigid tools and writes force, depth and deformed shapes.";
  u.details =
      "Implicit, quasi-static, incompressible or nearly so: the P1+/P1 mini-element, Newton's method with the consistent tangent, load\n"
      "steps that are halved when they fail. Tools move along their axes from where they first touch the organ, after gravity if there is\n"
      "any; patches of the surface are held, moved, loaded or sprung; effects such as viscosity are added to the laws. scheme = \"explicit\":\n"
      "a thin wall (palpate-mesh --kind shell) between two jaws, central differences, until the walls touch. `palpate list` shows laws,\n"
      "effects and tools with their parameters.";
  u.input("case", "case.toml", "the case: mesh, [material], what holds, loads and presses, [steps]");
  u.output("result", "result", "history.csv, frames.pvd with frames/*.vtu for ParaView, summary.json", ArgumentKind::folder);
  u.text("sensitivities", {}, "numbers of the case, such as material.mu, effect[0].g[1], tool.aim_mm[0], separated by commas: the forces' derivatives by them go into sensitivities.csv");
  u.file("mesh", "the mesh to use instead of the one the case names");
  u.catalogue = [] {
    std::vector<CatalogueEntry> entries = contact::entries();
    entries.insert(entries.begin(), elements::mini_tetrahedron_entry());
    for (const auto& law : materials::all()) entries.push_back(law.entry);
    for (const auto& effect : effects::all()) entries.push_back(effect.entry);
    for (const auto& tool : tools::all()) entries.push_back(tool.entry);
    return entries;
  };
}

namespace {

std::string remark(const Case& the_case, const implicit::Step& step) {
  std::ostringstream out;
  out.precision(3);
  const Driven d = driven(the_case, step);
  out << "depth " << d.depth << " mm, force " << d.force << " N";
  return out.str();
}

/// The last time was not reached: an error that helps, or a warning when the case asks for what there is.
void explain_stop(Command& c, const Case& the_case, double time, double depth, const implicit::Trouble& trouble) {
  std::ostringstream what, where;
  what << "stopped at " << time << " s of " << the_case.steps.times.back() << " s, at depth " << depth << " mm: " << trouble.cause;
  where << "near (" << trouble.place_mm.transpose() << ") mm of the organ at rest";
  if (!the_case.keep_partial || !(time > 0))
    throw Failure(ExitCode::not_converged, what.str(), where.str(), "[steps] keep_partial = true delivers what was reached");
  c.warn(what.str() + "; " + where.str());
}

/// Gravity first, without tools; then they come to where they touch the organ that has sagged.
void settle(Case& the_case, implicit::Equilibrium& equilibrium, implicit::State& state, ResultFolder& results, std::optional<Sensitivities>& sensitivities,
            const implicit::Observer& observe) {
  if (the_case.settling.times.empty()) return;
  take_tools_away(the_case);
  if (sensitivities) sensitivities->take_tools_away();
  const double reached =
      implicit::run_steps(equilibrium, state, the_case.settling, [&](const implicit::Step& step) { results.settled(step); }, observe);
  if (reached < 0) {
    std::ostringstream where;
    where << "near (" << equilibrium.trouble().place_mm.transpose() << ") mm of the organ at rest";
    throw Failure(ExitCode::not_converged, "gravity cannot be carried: " + equilibrium.trouble().cause, where.str(),
                  "hold more of the organ, or give [gravity] more steps");
  }
  bring_tools(the_case, state);
  if (sensitivities) sensitivities->bring_tools();
}

}  // namespace

void run(Command& c) {
  if (explicit_shell::is_explicit(c.input("case"))) {
    if (c.has("sensitivities")) throw Failure(ExitCode::misuse, "the explicit scheme has no sensitivities", "--sensitivities", "leave it out");
    return explicit_shell::solve(c);
  }
  const Settings settings = Settings::read(c.input("case"));
  const std::filesystem::path mesh = c.has("mesh") ? c.file("mesh") : "";
  Case the_case = read_case(settings, mesh);
  if (!c.has("mesh")) c.add_input("mesh", the_case.mesh_path);
  for (std::size_t i = 0; i < the_case.tool_files.size(); ++i) c.add_input("tool " + std::to_string(i + 1), the_case.tool_files[i]);
  c.say(std::to_string(the_case.model.points.size()) + " nodes, " + std::to_string(the_case.model.tets.size()) + " tetrahedra, " +
        std::to_string(the_case.base_nodes) + " nodes held");
  implicit::Equilibrium equilibrium(the_case.model, c.threads());
  implicit::State state = implicit::rest_state(the_case.model);
  ResultFolder results(c.output("result"), the_case, equilibrium.assembly());
  std::optional<Sensitivities> sensitivities;
  implicit::Observer observe;
  if (c.has("sensitivities")) {
    sensitivities.emplace(settings, mesh, number_paths(c.text("sensitivities")), equilibrium, c.threads());
    observe = [&](const implicit::State& found) { sensitivities->follow(found); };
  }
  Progress progress = c.progress("solve", the_case.count);
  settle(the_case, equilibrium, state, results, sensitivities, observe);
  const double time = implicit::run_steps(equilibrium, state, the_case.steps, [&](const implicit::Step& step) {
    results.add(step, step.index == the_case.count);
    if (sensitivities) sensitivities->add(step);
    progress.update(step.index, remark(the_case, step));
  }, observe);
  progress.finish();
  if (time < the_case.steps.times.back()) explain_stop(c, the_case, time, results.depth(), equilibrium.trouble());
  const Json summary = results.finish(time);
  if (sensitivities) write_text(c.output("result") / "sensitivities.csv", sensitivities->table());
  c.note("summary", summary);
  c.check(check_at_most("force balance", results.worst_force_imbalance(), 1e-3));
  c.check(check_at_most("penetration of the local element size", results.worst_penetration(), 0.01));
  c.check(check_at_least("smallest J", results.smallest_J(), 1e-6));
  std::ostringstream line;
  line << "peak force " << summary.at("peak_force_N").get<double>() << " N at depth " << results.depth() << " mm";
  c.print(line.str());
}
