// From histories, summaries and cards.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/facts.hpp>

#include <algorithm>
#include <cmath>

#include <pipeline/report/html.hpp>

namespace palpate {
namespace {

const Json& notes_of(const Study& study, const std::string& tool) {
  static const Json none = Json::object();
  const Json& card = card_of(study, tool);
  return card.is_object() && card.contains("notes") && card["notes"].is_object() ? card["notes"] : none;
}

/// A number of a card's notes; NaN when there is none.
double number_of(const Json& notes, const std::string& key) {
  return notes.contains(key) && notes[key].is_number() ? notes[key].get<double>() : std::nan("");
}

/// "the kidney"; "the organ" when the labels have no single name.
std::string organ(const Study& study) {
  const Json& notes = notes_of(study, "palpate-segment");
  if (notes.contains("label_names") && notes["label_names"].is_object() && notes["label_names"].size() == 1) {
    const Json& name = *notes["label_names"].begin();
    if (name.is_string()) return "the " + name.get<std::string>();
  }
  return "the organ";
}

std::string tool_words(const Json& summary) {
  if (summary.contains("clamp") && summary["clamp"].is_object()) {
    const double width = number_of(summary["clamp"], "width_mm"), length = number_of(summary["clamp"], "length_mm");
    return std::isfinite(width + length) ? "a clamp of " + readable(width) + " × " + readable(length) + " mm" : "a clamp";
  }
  if (!summary.contains("tool") || !summary["tool"].is_object()) return "a rigid tool";
  const Json& tool = summary["tool"];
  std::string kind = tool.contains("kind") && tool["kind"].is_string() ? tool["kind"].get<std::string>() : "rigid tool";
  std::replace(kind.begin(), kind.end(), '_', ' ');
  const double radius = number_of(tool, "radius_mm");
  return "a " + kind + (std::isfinite(radius) ? " of " + readable(2 * radius) + " mm diameter" : "");
}

std::string law_words(const Json& summary) {
  if (!summary.contains("law") || !summary["law"].is_string()) return "";
  std::string text = summary["law"].get<std::string>();
  if (!summary.contains("parameters") || !summary["parameters"].is_object()) return text;
  const char* separator = ": ";
  for (const auto& [name, value] : summary["parameters"].items()) {
    if (!value.is_number()) continue;
    text += separator + name + " " + readable(value.get<double>());
    separator = ", ";
  }
  return text;
}

std::string range_text(double low, double high, const std::string& unit) {
  const std::string a = readable(low, 3), b = readable(high, 3);
  return (a == b ? a : a + " to " + b) + " " + unit;
}

std::string pressing_sentence(const Study& study) {
  const ForceUnit unit = force_unit(study);
  double low = std::numeric_limits<double>::infinity(), high = -low, shallow = low, deep = high;
  for (const Solve& solve : study.solves) {
    const SolveFacts facts = facts_of(solve);
    low = std::min(low, facts.peak_force_N);
    high = std::max(high, facts.peak_force_N);
    shallow = std::min(shallow, facts.depth_reached_mm);
    deep = std::max(deep, facts.depth_reached_mm);
  }
  const Solve& first = study.solves.front();
  std::string text = "When " + tool_words(first.summary) + " presses " + range_text(shallow, deep, "mm") + " deep, " +
                     organ(study) + " resists with a peak force of " +
                     range_text(low * unit.per_newton, high * unit.per_newton, unit.name);
  if (study.solves.size() > 1) return text + (first.summary.contains("clamp") ? ", over " + std::to_string(study.solves.size()) + " runs." : ", depending on the law (" + std::to_string(study.solves.size()) + " compared).");
  if (first.summary.contains("law") && first.summary["law"].is_string())
    text += " (" + first.summary["law"].get<std::string>() + ")";
  return text + ".";
}

std::string smallest_angle(const Json& mesh_notes) {
  try {
    return readable(mesh_notes.at("quality").at("dihedral_deg").at("min").get<double>(), 3);
  } catch (const Json::exception&) {
    return "";
  }
}

}  // namespace

SolveFacts facts_of(const Solve& solve) {
  const auto &depths = solve.history.column("depth[mm]"), &forces = solve.history.column("F[N]");
  SolveFacts facts;
  facts.steps = static_cast<long>(depths.size());
  const auto peak = std::max_element(forces.begin(), forces.end());
  facts.peak_force_N = *peak;
  facts.depth_at_peak_mm = depths[peak - forces.begin()];
  facts.depth_reached_mm = *std::max_element(depths.begin(), depths.end());
  if (solve.summary.contains("depth_mm") && solve.summary["depth_mm"].is_object()) {
    const double asked = number_of(solve.summary["depth_mm"], "asked");
    if (std::isfinite(asked)) facts.depth_asked_mm = asked;
  }
  const double smallest_J = number_of(solve.summary, "smallest_J");
  if (std::isfinite(smallest_J)) facts.smallest_J = smallest_J;
  facts.law = law_words(solve.summary);
  for (double area : solve.history.column("contact_area[mm2]")) facts.contact_area_mm2 = std::max(facts.contact_area_mm2, area);
  for (double count : solve.history.column("iterations")) facts.iterations += static_cast<long>(count);
  if (const double cycles = number_of(solve.summary, "cycles"); std::isfinite(cycles)) facts.iterations = static_cast<long>(cycles);  // counted on in each row
  return facts;
}

ForceUnit force_unit(const Study& study) {
  double largest = 0;
  for (const Solve& solve : study.solves) largest = std::max(largest, std::abs(facts_of(solve).peak_force_N));
  return largest < 0.1 ? ForceUnit{1000, "mN"} : ForceUnit{};
}

CheckCount checks_of(const Json& card) {
  CheckCount count;
  if (card.is_object() && card.contains("checks") && card["checks"].is_array())
    for (const Json& check : card["checks"])
      ++(check.is_object() && check.contains("pass") && check["pass"] == true ? count.passed : count.failed);
  return count;
}

CheckCount checks_of(const Study& study) {
  CheckCount sum;
  for (const Stage& stage : study.stages) {
    const CheckCount count = checks_of(stage.card);
    sum.passed += count.passed;
    sum.failed += count.failed;
  }
  return sum;
}

std::string result_sentence(const Study& study) {
  if (!study.solves.empty()) return pressing_sentence(study);
  const Json& mesh = notes_of(study, "palpate-mesh");
  const double tets = number_of(mesh, "tets"), volume = number_of(mesh, "volume_mm3");
  if (std::isfinite(tets) && std::isfinite(volume)) {
    const std::string angle = smallest_angle(mesh);
    return readable(tets, 15) + " tetrahedra fill " + organ(study) + " of " + readable(volume / 1000, 3) + " ml" +
           (angle.empty() ? "." : "; the smallest dihedral angle is " + angle + "°.");
  }
  return "The study ends before a mesh: this page shows what there is.";
}

std::vector<Tile> tiles(const Study& study) {
  std::vector<Tile> list;
  const ForceUnit unit = force_unit(study);
  double force = 0, depth = 0, area = 0;
  for (const Solve& solve : study.solves) {
    const SolveFacts facts = facts_of(solve);
    force = std::max(force, facts.peak_force_N);
    depth = std::max(depth, facts.depth_reached_mm);
    area = std::max(area, facts.contact_area_mm2);
  }
  if (!study.solves.empty()) {
    list.push_back(
        {study.solves.size() > 1 ? "largest peak force" : "peak force", readable(force * unit.per_newton, 3), unit.name});
    list.push_back({"depth reached", readable(depth, 3), "mm"});
    if (area > 0) list.push_back({"contact area", readable(area, 3), "mm²"});
  }
  const Json &mesh = notes_of(study, "palpate-mesh"), &surface = notes_of(study, "palpate-surface");
  const double volume = number_of(mesh, "volume_mm3"), tets = number_of(mesh, "tets");
  if (std::isfinite(volume))
    list.push_back({"volume", readable(volume / 1000, 3), "ml"});
  else if (std::isfinite(number_of(surface, "volume_mm3")))
    list.push_back({"volume", readable(number_of(surface, "volume_mm3") / 1000, 3), "ml"});
  if (std::isfinite(tets)) list.push_back({"tetrahedra", readable(tets, 15), ""});
  const std::string angle = smallest_angle(mesh);
  if (!angle.empty()) list.push_back({"smallest dihedral", angle, "°"});
  const CheckCount checks = checks_of(study);
  if (checks.passed + checks.failed > 0)
    list.push_back({"checks passed", std::to_string(checks.passed), "of " + std::to_string(checks.passed + checks.failed)});
  return list;
}

}  // namespace palpate
