// Sections of the page, each from what the study has; what is missing is left out.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/page.hpp>

#include <algorithm>
#include <set>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <pipeline/report/facts.hpp>
#include <pipeline/report/force_plots.hpp>
#include <pipeline/report/html.hpp>
#include <pipeline/report/shell.hpp>

namespace palpate {

namespace {

/// The free facts of a stage, without what is shown elsewhere.
std::string notes_html(const Study& study, const std::string& tool, const std::string& title,
                       const std::set<std::string>& shown_elsewhere) {
  const Json& card = card_of(study, tool);
  if (!card.is_object() || !card.contains("notes") || !card["notes"].is_object()) return "";
  Json rest = Json::object();
  for (const auto& [key, value] : card["notes"].items())
    if (!shown_elsewhere.contains(key)) rest[key] = value;
  return rest.empty() ? "" : "<h3>" + title + "</h3>\n" + facts_html(rest);
}

std::string checks_text(const CheckCount& count) {
  const long all = count.passed + count.failed;
  return all == 0 ? "no checks" : std::to_string(count.passed) + "/" + std::to_string(all) + (all == 1 ? " check" : " checks");
}

std::string stage_strip(const Study& study) {
  std::string html = "<ol class=\"strip\" aria-label=\"stages\">\n";
  for (std::size_t i = 0; i < study.stages.size(); ++i) {
    const Stage& stage = study.stages[i];
    const CheckCount count = checks_of(stage.card);
    const bool timed = stage.card.is_object() && stage.card.contains("seconds") && stage.card["seconds"].is_number();
    const std::string state = count.failed > 0 ? "fail" : count.passed > 0 ? "pass" : "none";
    html += "<li><a class=\"" + state + "\" href=\"#card-" + std::to_string(i) + "\"><b>" + escaped(stage.name) + "</b><span>" +
            (timed ? readable(stage.card["seconds"].get<double>(), 3) + " s · " : "") +
            (stage.card.is_null() ? "no card" : checks_text(count)) + "</span></a></li>\n";
  }
  return html + "</ol>\n";
}

std::string head_html(const Study& study) {
  std::string html = "<header class=\"top\">\n<p class=\"kind\">Palpate study</p>\n<h1>" + escaped(study.title) +
                     "</h1>\n<p class=\"lead\">" + escaped(result_sentence(study)) + "</p>\n<dl class=\"tiles\">\n";
  for (const Tile& tile : tiles(study))
    html += "<div><dt>" + escaped(tile.label) + "</dt><dd>" + tile.value + " <small>" + tile.unit + "</small></dd></div>\n";
  return html + "</dl>\n" + stage_strip(study) + "</header>\n";
}

std::string sheet_html(const Study& study) {
  if (study.sheet_png.empty()) return "";
  return "<p>Slices of the scan with the contour of the labels drawn: does the line follow the organ?</p>\n"
         "<figure class=\"sheet\"><img alt=\"Contact sheet: slices of the scan with the contour of the labels\" "
         "src=\"data:image/png;base64," +
         base64(study.sheet_png) + "\"></figure>\n" + notes_html(study, "palpate-segment", "Labels in numbers", {});
}

std::string pictures_html(const std::vector<NamedPicture>& pictures, const std::string& what, const std::string& css_class) {
  std::string html = "<div class=\"" + css_class + "\">\n";
  for (const auto& [name, picture] : pictures) html += picture_figure(picture, what + ", " + name, escaped(name));
  return html + "</div>\n";
}

std::string surface_html(const Study& study, const Drawings& drawings) {
  if (drawings.surface.empty()) return "";
  return "<p class=\"hint\">Letters are the patient's directions: L left, R right, A front, P back, S head, I feet.</p>\n" +
         pictures_html(drawings.surface, "Surface of the organ", "pictures three") +
         notes_html(study, "palpate-surface", "Volume ledger and measures", {});
}

/// Bars of "dihedral_histogram": {"bin_deg": 10, "count": [18 numbers]} of the mesh card; nothing when the card has none.
std::string histogram_html(const Json& quality) {
  if (!quality.is_object() || !quality.contains("dihedral_histogram")) return "";
  const Json& histogram = quality["dihedral_histogram"];
  if (!histogram.contains("bin_deg") || !histogram.contains("count")) return "";
  const double bin = histogram["bin_deg"].get<double>();
  Json labels = Json::array();
  for (std::size_t i = 0; i < histogram["count"].size(); ++i)
    labels.push_back(readable(bin * i) + "–" + readable(bin * (i + 1)) + "°");
  const Json plot = {
      {"kind", "bars"}, {"x", "dihedral angle"}, {"y", "angles"}, {"labels", labels}, {"counts", histogram["count"]}};
  return "<h3>Shape of the tetrahedra</h3>\n<p class=\"hint\">All six dihedral angles of every tetrahedron; the regular one has "
         "70.5°, flat ones have angles near 0° and 180°.</p>\n" +
         plot_figure("plot-quality", plot, "Histogram of the dihedral angles of the mesh", "plot low");
}

/// min, 1 % and median of each measure in the mesh card's "quality".
std::string quality_table(const Json& quality) {
  std::string rows;
  for (const auto& [key, title] :
       {std::pair{"dihedral_deg", "smallest dihedral angle (°)"}, std::pair{"radius_ratio", "radius ratio 3r/R"},
        std::pair{"scaled_jacobian", "scaled Jacobian"}}) {
    if (!quality.is_object() || !quality.contains(key)) continue;
    std::vector<std::string> cells{title};
    for (const char* column : {"min", "one_percent", "median"}) {
      const Json value = quality[key].value(column, Json());
      cells.push_back(value.is_number() ? readable(value.get<double>(), 3) : "–");
    }
    rows += table_row(cells, "td", 1);
  }
  if (rows.empty()) return "";
  return wide("<table><thead>" + table_row({"quality", "minimum", "1 % below", "median"}, "th", 1) + "</thead><tbody>" + rows +
              "</tbody></table>");
}

std::string mesh_html(const Study& study, const Drawings& drawings) {
  if (drawings.mesh.empty()) return "";
  const Json& card = card_of(study, "palpate-mesh");
  const Json quality =
      card.is_object() && card.contains("notes") && card["notes"].is_object() ? card["notes"].value("quality", Json()) : Json();
  std::string shape;
  try {
    shape = histogram_html(quality) + quality_table(quality);
  } catch (const Json::exception& error) {
    throw Failure(ExitCode::unreadable, std::string("the quality of the mesh is not readable: ") + error.what(),
                  card_path(study.mesh).string(), "run palpate-mesh again");
  }
  return pictures_html(drawings.mesh, "Tetrahedral mesh", "pictures") + shape +
         notes_html(study, "palpate-mesh", "Mesh in numbers", {"quality"});
}

std::string solves_table(const Study& study) {
  const ForceUnit unit = force_unit(study);
  std::string rows;
  for (const Solve& solve : study.solves) {
    const SolveFacts facts = facts_of(solve);
    rows += table_row(
        {escaped(solve.name), readable(facts.peak_force_N * unit.per_newton), readable(facts.depth_at_peak_mm, 3),
         readable(facts.depth_reached_mm, 3) + (facts.depth_asked_mm > 0 ? " of " + readable(facts.depth_asked_mm, 3) : ""),
         facts.contact_area_mm2 > 0 ? readable(facts.contact_area_mm2, 3) : "–", std::to_string(facts.steps - 1),
         std::to_string(facts.iterations), facts.smallest_J > 0 ? readable(facts.smallest_J) : "–"},
        "td", 1);
  }
  const std::vector<std::string> heads{"solve",
                                       "peak force (" + unit.name + ")",
                                       "at depth (mm)",
                                       "depth reached (mm)",
                                       "largest contact area (mm²)",
                                       "steps",
                                       "iterations or cycles",
                                       "smallest J"};
  std::string laws;
  for (const Solve& solve : study.solves)
    if (const std::string law = facts_of(solve).law; !law.empty())
      laws += "<li><b>" + escaped(solve.name) + "</b> " + escaped(law) + "</li>\n";
  return wide("<table><thead>" + table_row(heads, "th", 1) + "</thead><tbody>" + rows + "</tbody></table>") +
         (laws.empty() ? ""
                       : "<p class=\"hint laws\">Laws and their parameters (stresses in MPa):</p><ul class=\"hint\">\n" + laws +
                             "</ul>\n");
}

std::string force_html(const Study& study) {
  if (study.solves.empty()) return "";
  return "<p class=\"hint\">Force along the tool's axis, positive when the organ resists. Point at a curve for its "
         "values.</p>\n" +
         force_plot(study) + motion_plot(study) + solves_table(study);
}

std::string pressed_html(const Drawings& drawings) {
  if (drawings.pressed.empty()) return "";
  std::string html =
      "<p class=\"hint\">Each solve at its greatest depth, not magnified. <span class=\"key\" style=\"background: "
      "#bf267d\"></span> the organ at rest. "
      "Stress is drawn as computed, one value per element; its colours end where 99.5 % of the elements lie below, the "
      "same in all pictures. A thin wall is drawn as its mid-surface between the jaws' outlines.</p>\n";
  for (const PressedDrawing& drawing : drawings.pressed) {
    html += "<h3>" + escaped(drawing.solve) + " at " + readable(drawing.depth_mm, 3) + " mm</h3>\n<div class=\"pictures\">\n";
    const std::string what = "Organ pressed with " + drawing.solve;
    if (!drawing.wall)
      html += picture_figure(drawing.outside, what + ", from outside, coloured by displacement",
                           "outside; largest displacement " + readable(drawing.largest_displacement_mm, 3) + " mm");
    for (const auto& [name, picture] : drawing.sections)
      html +=
          picture_figure(picture, what + (drawing.wall ? ", wall coloured by von Mises stress, " : ", section along the tool's axis coloured by von Mises stress, ") + name,
                         escaped(name) + "; largest von Mises stress " + readable(drawing.largest_stress_mpa * 1000, 3) + " kPa");
    html += "</div>\n";
  }
  const bool only_walls = std::all_of(drawings.pressed.begin(), drawings.pressed.end(), [](const PressedDrawing& drawing) { return drawing.wall; });
  return html + (only_walls ? "" : colour_bar("displacement", Tones::displacement, readable(drawings.displacement_scale_mm, 3) + " mm")) +
         colour_bar("von Mises stress", Tones::stress, readable(drawings.stress_scale_mpa * 1000, 3) + " kPa and more");
}

std::string check_value(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number()) return readable(value.get<double>(), 5);
  return value.is_null() ? "not a number" : escaped(value.is_string() ? value.get<std::string>() : value.dump());
}

std::string checks_html(const Study& study) {
  std::string rows;
  for (const Stage& stage : study.stages) {
    if (!stage.card.is_object() || !stage.card.contains("checks") || !stage.card["checks"].is_array()) continue;
    for (const Json& check : stage.card["checks"]) {
      const bool pass = check.value("pass", false);
      rows += std::string(pass ? "<tr>" : "<tr class=\"fail\">") + "<td>" + escaped(stage.name) + "</td><th scope=\"row\">" +
              escaped(check.value("name", "")) + "</th><td class=\"n\">" + check_value(check.value("value", Json())) +
              "</td><td>" + escaped(check.value("limit", "")) + "</td><td class=\"" +
              (pass ? "pass-mark\">✓ pass" : "fail-mark\">✗ fail") + "</td></tr>\n";
    }
  }
  if (rows.empty()) return "";
  return wide(
      "<table><thead><tr><th scope=\"col\">stage</th><th scope=\"col\">check</th><th scope=\"col\" class=\"n\">value</th>"
      "<th scope=\"col\">limit</th><th scope=\"col\">verdict</th></tr></thead><tbody>\n" +
      rows + "</tbody></table>");
}

std::string warnings_html(const Study& study) {
  std::string items;
  for (const Stage& stage : study.stages)
    if (stage.card.is_object() && stage.card.contains("warnings") && stage.card["warnings"].is_array())
      for (const Json& warning : stage.card["warnings"])
        items += "<li><b>" + escaped(stage.name) + "</b> " + check_value(warning) + "</li>\n";
  return items.empty() ? "" : "<h3>Warnings</h3>\n<ul>\n" + items + "</ul>\n";
}

std::string cards_html(const Study& study) {
  std::string html = "<p class=\"hint\">What made each file, from what, with which options, and the hashes of the bytes.</p>\n";
  for (std::size_t i = 0; i < study.stages.size(); ++i) {
    const Stage& stage = study.stages[i];
    if (stage.card.is_null()) continue;
    html += "<details id=\"card-" + std::to_string(i) + "\"><summary>" + escaped(stage.name) + " <span>" +
            escaped(stage.card.value("tool", "")) + " " + escaped(stage.card.value("version", "")) +
            "</span></summary>\n<pre tabindex=\"0\">" + escaped(stage.card.dump(2)) + "</pre></details>\n";
  }
  for (const Solve& solve : study.solves)
    if (!solve.summary.empty())
      html += "<details><summary>" + escaped(solve.name) + " <span>summary.json</span></summary>\n<pre tabindex=\"0\">" +
              escaped(solve.summary.dump(2)) + "</pre></details>\n";
  return html;
}

std::string versions(const Study& study) {
  std::set<std::string> names;
  for (const Stage& stage : study.stages)
    if (stage.card.is_object()) names.insert(stage.card.value("version", "?"));
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "unknown" : text;
}

}  // namespace

std::string page_html(const Study& study, const Drawings& drawings, const Additions& additions) {
  const std::string body =
      section("force", "Force and depth", force_html(study)) + section("loop", "What the model lacks", additions.missing_effect) +
      section("compare", "Side by side", additions.side_by_side) +
      section("pressed", "The pressed organ", pressed_html(drawings)) + section("scan", "Scan and labels", sheet_html(study)) +
      section("surface", "Surface", surface_html(study, drawings)) + section("mesh", "Mesh", mesh_html(study, drawings)) +
      section("checks", "Checks", checks_html(study) + warnings_html(study)) + section("cards", "Cards", cards_html(study));
  return whole_page(study.title, head_html(study), body, versions(study));
}

}  // namespace palpate
