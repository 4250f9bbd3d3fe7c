// palpate-solve: presses an organ with a rigid tool.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <solver/results.hpp>

#include <sstream>

using namespace palpate;

void usage(Usage& u) {
  u.name = "solve";
  u.sentence = "Presses an organ of tetrahedra with a rigid tool and writes force, depth and deformed shapes.";
  u.details =
      "Implicit, quasi-static, incompressible or nearly so: the P1+/P1 mini-element, Newton's method with the consistent tangent, load\n"
      "steps that are halved when they fail. The tool moves along its axis from where it first touches the organ. The case names mesh,\n"
      "material, base and tool; `palpate list` shows laws and tools with their parameters.";
  u.input("case", "case.toml", "the case: mesh, [material], [base], [tool], [steps]");
  u.output("result", "result", "history.csv, frames.pvd with frames/*.vtu for ParaView, summary.json", ArgumentKind::folder);
  u.file("mesh", "the mesh to use instead of the one the case names");
  u.catalogue = [] {
    std::vector<CatalogueEntry> entries = {elements::mini_tetrahedron_entry(), contact::frictionless_entry()};
    for (const auto& law : materials::all()) entries.push_back(law.entry);
    for (const auto& tool : tools::all()) entries.push_back(tool.entry);
    return entries;
  };
}

namespace {

std::string remark(const implicit::Step& step, const contact::Tool& tool) {
  std::ostringstream out;
  out.precision(3);
  out << "depth " << step.state.load * tool.depth << " mm, force " << step.equations.contact.force.dot(tool.axis) << " N";
  return out.str();
}

/// Full depth was not reached: an error that helps, or a warning when the case asks for what there is.
void explain_stop(Command& c, const Case& the_case, double load, const implicit::Trouble& trouble) {
  std::ostringstream what, where;
  what << "stopped at depth " << load * the_case.model.tool->depth << " mm of " << the_case.model.tool->depth << " mm: " << trouble.cause;
  where << "near (" << trouble.place_mm.transpose() << ") mm of the organ at rest";
  if (!the_case.keep_partial || load == 0)
    throw Failure(ExitCode::not_converged, what.str(), where.str(), "[steps] keep_partial = true delivers what was reached");
  c.warn(what.str() + "; " + where.str());
}

}  // namespace

void run(Command& c) {
  const Case the_case = read_case(c.input("case"), c.has("mesh") ? c.file("mesh") : "");
  if (!c.has("mesh")) c.add_input("mesh", the_case.mesh_path);
  c.say(std::to_string(the_case.model.points.size()) + " nodes, " + std::to_string(the_case.model.tets.size()) + " tetrahedra, " +
        std::to_string(the_case.base_nodes) + " nodes held");
  implicit::Equilibrium equilibrium(the_case.model, c.threads());
  implicit::State state = implicit::rest_state(the_case.model);
  ResultFolder results(c.output("result"), the_case, equilibrium.assembly());
  Progress progress = c.progress("solve", the_case.steps.count);
  const double load = implicit::run_steps(equilibrium, state, the_case.steps, [&](const implicit::Step& step) {
    results.add(step, step.index == the_case.steps.count);
    progress.update(step.index, remark(step, *the_case.model.tool));
  });
  progress.finish();
  if (load < 1) explain_stop(c, the_case, load, equilibrium.trouble());
  const Json summary = results.finish(load);
  c.note("summary", summary);
  c.check(check_at_most("force balance of tool and base", results.worst_force_imbalance(), 1e-3));
  c.check(check_at_most("penetration of the local element size", results.worst_penetration(), 0.01));
  c.check(check_at_least("smallest J", results.smallest_J(), 1e-6));
  std::ostringstream line;
  line << "peak force " << summary.at("peak_force_N").get<double>() << " N at depth " << load * the_case.model.tool->depth << " mm";
  c.print(line.str());
}
