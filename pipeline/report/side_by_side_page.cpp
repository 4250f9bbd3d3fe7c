// Curves on one plot, maxima over a quantity, another source's growths beside ours, diameters, and the table of everything.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/side_by_side_page.hpp>

#include <algorithm>
#include <vector>

#include <palpate/errors.hpp>
#include <palpate/json.hpp>
#include <pipeline/report/html.hpp>
#include <pipeline/report/shell.hpp>

namespace palpate {
namespace {

Json points(const Json& x, const Json& y) {
  Json list = Json::array();
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i].is_number() && y[i].is_number()) list.push_back({x[i], y[i]});
  return list;
}

std::string lines(const std::string& id, const std::string& x, const std::string& y, const Json& series, const std::string& alt) {
  return plot_figure(id, {{"kind", "lines"}, {"x", x}, {"y", y}, {"series", series}}, alt, "plot");
}

std::string with_unit(const std::string& quantity, const std::string& unit) { return unit == "1" ? quantity : quantity + " (" + unit + ")"; }

const Json* row_of(const Json& comparison, const std::string& quantity) {
  for (const Json& row : comparison.at("rows"))
    if (row.at("quantity") == quantity) return &row;
  return nullptr;
}

std::string curves_html(const Json& comparison) {
  Json series = Json::array();
  for (const Json& curve : comparison.at("curves")) series.push_back({{"name", curve.at("result")}, {"points", points(curve.at("depth_mm"), curve.at("force_N"))}});
  return lines("plot-compare-force", "depth (mm)", "force (N)", series, "Force over depth of the results side by side");
}

/// One plot per group of quantities that share a unit.
std::string over_html(const Json& comparison) {
  const Json& over = comparison.at("over");
  if (!over.is_object()) return "";
  const std::string x = with_unit(over.at("quantity"), over.at("unit"));
  const Json& names = comparison.at("results");
  std::string html = "<h3>Over " + escaped(over.at("quantity")) + "</h3>\n<div class=\"facts\">\n";
  int number = 0;
  for (const auto& group : std::vector<std::vector<std::string>>{{"largest von Mises stress"}, {"99.5 % von Mises stress"}, {"largest strain"}, {"99.5 % strain"},
                                                                 {"peak force", "last force"}, {"mean contact pressure at the end", "peak contact pressure"}}) {
    Json series = Json::array();
    std::string unit;
    for (const std::string& quantity : group) {
      const Json* row = row_of(comparison, quantity);
      if (!row) continue;
      unit = row->at("unit");
      for (const Json& one : over.at("series")) {
        Json values = Json::array();
        for (const Json& result : one.at("results")) values.push_back(row->at("values").at(std::find(names.begin(), names.end(), result) - names.begin()));
        series.push_back({{"name", one.at("name").get<std::string>() + (group.size() > 1 ? ", " + quantity : "")}, {"points", points(one.at("at"), values)}});
      }
    }
    if (series.empty()) continue;
    const std::string title = group.size() > 1 ? unit == "N" ? "force" : "contact pressure" : group.front();
    html += "<div>" + lines("plot-over-" + std::to_string(number++), x, with_unit(title, unit), series, title + " over " + over.at("quantity").get<std::string>()) + "</div>\n";
  }
  return html + "</div>\n";
}

std::string beside_html(const Json& beside) {
  if (!beside.is_object()) return "";
  std::string rows;
  for (const Json& g : beside.at("growths"))
    rows += table_row({escaped(g.at("series").get<std::string>() + ", " + g.at("quantity").get<std::string>()), readable(g.at("from").get<double>()) + " → " + readable(g.at("to").get<double>()),
                       readable(g.at("theirs_percent").get<double>(), 3), g.at("ours_percent").is_number() ? readable(g.at("ours_percent").get<double>(), 3) : "–"},
                      "td", 1);
  return "<h3>Growth beside " + escaped(beside.at("source")) + "</h3>\n" +
         wide("<table><thead>" + table_row({"growth of", "from → to", "theirs (%)", "ours (%)"}, "th", 1) + "</thead><tbody>" + rows + "</tbody></table>");
}

std::string diameters_html(const Json& comparison) {
  Json series = Json::array();
  for (const Json& d : comparison.at("diameters")) series.push_back({{"name", d.at("result")}, {"points", points(d.at("arc_mm"), d.at("diameter_mm"))}});
  if (series.empty()) return "";
  return "<h3>Diameter along the centre line</h3>\n<p class=\"hint\">Of the mid-surface at rest: of the circle with the area of the section at right angles. Nearer "
         "to a rim than half a diameter it cuts the section off.</p>\n" +
         lines("plot-compare-diameter", "along the centre line (mm)", "diameter (mm)", series, "Diameter of each wall along its centre line");
}

std::string rows_html(const Json& comparison) {
  std::vector<std::string> heads{"quantity", "unit"};
  for (const Json& name : comparison.at("results")) heads.push_back(escaped(name));
  std::string rows, group;
  for (const Json& row : comparison.at("rows")) {
    if (row.at("group") != group) {
      group = row.at("group");
      rows += "<tr><th colspan=\"" + std::to_string(heads.size()) + "\" scope=\"colgroup\">" + escaped(group) + "</th></tr>";
    }
    std::vector<std::string> cells{escaped(row.at("quantity")), escaped(row.at("unit"))};
    for (const Json& value : row.at("values")) cells.push_back(value.is_number() ? readable(value.get<double>()) : "–");
    rows += table_row(cells, "td", 2);
  }
  return "<h3>In numbers</h3>\n" + wide("<table><thead>" + table_row(heads, "th", 2) + "</thead><tbody>" + rows + "</tbody></table>");
}

}  // namespace

std::string side_by_side_html(const std::filesystem::path& folder) {
  const auto file = folder / "compare.json";
  if (!std::filesystem::is_regular_file(file)) return "";
  const Json comparison = read_json(file);
  try {
    if (comparison.at("schema") != "palpate-compare/1") throw Failure(ExitCode::unreadable, "not a comparison this version reads", file.string(), "run palpate-compare again");
    return curves_html(comparison) + over_html(comparison) + beside_html(comparison.at("beside")) + diameters_html(comparison) + rows_html(comparison);
  } catch (const Json::exception& error) {
    throw Failure(ExitCode::unreadable, std::string("not a comparison: ") + error.what(), file.string(), "run palpate-compare again");
  }
}

}  // namespace palpate
