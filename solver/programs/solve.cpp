// palpate-solve: presses an organ with rigid tools.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <solver/explicit/report.hpp>
#include <solver/run.hpp>

#include <sstream>

using namespace palpate;

namespace {

/// With its socket and with what may be left out.
CatalogueEntry listed(const effects::Effect& effect) {
  CatalogueEntry entry = effect.entry;
  entry.sentence += std::string(" (") + effects::socket(effect) + ")";
  for (std::size_t i = 0; i < entry.parameters.size(); ++i)
    if (const double* fallback = effects::fallback(effect, i)) {
      std::ostringstream text;
      text << " (default " << *fallback << ")";
      entry.parameters[i].meaning += text.str();
    }
  return entry;
}

}  // namespace

void usage(Usage& u) {
  u.name = "solve";
  u.sentence = "Presses an organ of tetrahedra with rigid tools and writes force, depth and deformed shapes.";
  u.details =
      "Implicit, quasi-static, incompressible or nearly so: the P1+/P1 mini-element, Newton's method with the consistent tangent, load\n"
      "steps that are halved when they fail. Tools move along their axes from where they first touch the organ, after gravity if there is\n"
      "any; patches of the surface are held, moved, loaded or sprung; effects are added: on the stress, at the start, as layers, between organ and tool. scheme = \"explicit\":\n"
      "a thin wall (palpate-mesh --kind shell) between two jaws, central differences, until the walls touch, with the same effects. `palpate list` shows laws,\n"
      "effects and tools with their parameters. A run that was killed goes on where the same command is given again, to the same bytes.";
  u.continues = true;
  u.input("case", "case.toml", "the case: mesh, [material], what holds, loads and presses, [steps]");
  u.output("result", "result", "history.csv, frames.pvd with frames/*.vtu for ParaView, summary.json", ArgumentKind::folder);
  u.text("sensitivities", {}, "numbers of the case, such as material.mu, effect[0].g[1], tool.aim_mm[0], separated by commas: the forces' derivatives by them go into sensitivities.csv");
  u.file("mesh", "the mesh to use instead of the one the case names");
  u.catalogue = [] {
    std::vector<CatalogueEntry> entries = contact::entries();
    entries.insert(entries.begin(), elements::mini_tetrahedron_entry());
    for (const auto& law : materials::all()) entries.push_back(law.entry);
    for (const auto& effect : effects::all()) entries.push_back(listed(effect));
    for (const auto& load : load_entries()) entries.push_back(load);
    for (const auto& tool : tools::all()) entries.push_back(tool.entry);
    return entries;
  };
}

void run(Command& c) {
  if (explicit_shell::is_explicit(c.input("case"))) {
    if (c.has("sensitivities")) throw Failure(ExitCode::misuse, "the explicit scheme has no sensitivities", "--sensitivities", "leave it out");
    return explicit_shell::solve(c);
  }
  Run solve(c);
  solve.go();
  const Json summary = solve.finish();
  const ResultFolder& results = solve.results();
  c.note("summary", summary);
  c.check(check_at_most("force balance", results.worst_force_imbalance(), 1e-3));
  c.check(check_at_most("penetration of the local element size", results.worst_penetration(), 0.01));
  c.check(check_at_least("smallest J", results.smallest_J(), 1e-6));
  std::ostringstream line;
  line << "peak force " << summary.at("peak_force_N").get<double>() << " N at depth " << results.depth() << " mm";
  c.print(line.str());
}
