// palpate-compare: results side by side.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sstream>

#include <palpate/command.hpp>
#include <palpate/text_file.hpp>
#include <pipeline/compare/side_by_side.hpp>

using namespace palpate;

void usage(Usage& u) {
  u.name = "compare";
  u.sentence = "Sets results of palpate-solve side by side: geometry, mesh quality, curves, maxima, with units.";
  u.details =
      "A result is a folder that palpate-solve wrote; a study's folder stands for all of its solves. compare.json and compare.csv hold one row per "
      "quantity and one column per result, and the change against the first result in percent; curves.csv holds the curves. Geometry and mesh "
      "quality are those of the mesh at rest, stresses those at the greatest depth; a quantity that a result does not have stays empty there. "
      "Written as compare/ into a study's folder it becomes a section of palpate-report's page. With --over, results whose names differ in the "
      "number at their end (wall-0.8, wall-2) are points of a series.";
  u.several_inputs("results", "result", "folders of palpate-solve, or of studies that hold some", ArgumentKind::open_folder);
  u.output("comparison", "compare", "compare.json, compare.csv, curves.csv", ArgumentKind::folder);
  u.text("over", {}, "a quantity of the rows, such as thickness, that series are drawn over; default: none");
  u.file("beside", "growths that another source reports, set beside ours (TOML, schema palpate-beside/1); needs --over");
}

void run(Command& c) {
  std::vector<Measured> results;
  const auto named = named_results(c.inputs("results"));
  Progress progress = c.progress("compare", named.size());
  for (const auto& [name, folder] : named) {
    std::vector<std::filesystem::path> files;
    Solve solve = read_solve(folder, files);
    for (const auto& file : files) c.add_input(file.lexically_proximate(folder.parent_path()).generic_string(), file);
    results.push_back(measure(name, std::move(solve)));
    progress.update(results.size(), name);
  }
  const Json comparison = side_by_side(results, c.has("over") ? c.text("over") : "", c.has("beside") ? std::optional(read_beside(c.file("beside"))) : std::nullopt);
  write_json(c.output("comparison") / "compare.json", comparison);
  write_text(c.output("comparison") / "compare.csv", rows_csv(comparison));
  write_text(c.output("comparison") / "curves.csv", curves_csv(comparison));
  c.note("results", comparison.at("results"));
  c.note("quantities", comparison.at("rows").size());
  std::ostringstream line;
  line << results.size() << " results, " << comparison.at("rows").size() << " quantities";
  c.print(line.str());
}
