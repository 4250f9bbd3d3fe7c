// Sections of the loop's page. One scale for all curves, so that what is small looks small.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/loop_page.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include <palpate/errors.hpp>
#include <pipeline/report/html.hpp>
#include <pipeline/report/shell.hpp>

namespace palpate {
namespace {

const std::map<std::string, std::string>& verdicts() {
  static const std::map<std::string, std::string> words = {{"claimed", "missing effect named"},
                                                           {"confounded", "one of several effects"},
                                                           {"unexplained", "unexplained"},
                                                           {"nothing_supported", "nothing missing"},
                                                           {"ranking_only", "ranking only"}};
  return words;
}

/// Newtons, or millinewtons where all is small; stresses in kPa where all is small.
struct Unit {
  double factor = 1;
  std::string name;
};

Unit unit_of(const Findings& findings) {
  double largest = 0;
  for (const auto& run : findings.runs)
    for (double x : run.measured) largest = std::max(largest, std::abs(x));
  const bool stress = findings.report.value("unit", "N") == "MPa";
  if (largest < 0.5) return {1e3, stress ? "kPa" : "mN"};
  return {1, stress ? "MPa" : "N"};
}

std::string number(const Json& value, int digits = 3) { return value.is_number() ? readable(value.get<double>(), digits) : "–"; }

std::string percent(const Json& error) { return error.is_object() ? number(error.at("percent"), 2) + " %" : "–"; }

std::string tile(const std::string& label, const std::string& value, const std::string& small) {
  return "<div><dt>" + label + "</dt><dd>" + value + " <small>" + small + "</small></dd></div>\n";
}

std::string tiles_html(const Json& report) {
  const Json &before = report.at("error").at("before"), &after = report.at("error").at("after");
  std::string html = "<dl class=\"tiles\">\n" +
                     tile("error on fitted runs", percent(before.at("fit")) + " → " + percent(after.at("fit")), "of the largest force");
  if (after.at("holdout").is_object()) {
    html += tile("error on sealed runs", percent(before.at("holdout")) + " → " + percent(after.at("holdout")), "of the largest force");
    html += tile("sealed error after", number(after.at("holdout").at("times_noise_floor"), 2), "× noise floor");
  }
  if (report.contains("sealed_looks")) html += tile("looks at sealed runs", number(report.at("sealed_looks")), "in all");
  if (report.value("solves", 0) > 0) html += tile("solves", number(report.at("solves"), 6), "");
  return html + "</dl>\n";
}

Json points(const std::vector<double>& x, const std::vector<double>& y, double factor) {
  Json list = Json::array();
  for (std::size_t i = 0; i < x.size(); ++i) list.push_back({x[i], y[i] * factor});
  return list;
}

/// Least and greatest of columns of all runs and 0, widened to a round number.
template <class Column>
Json range(const std::vector<MeasuredRun>& runs, double factor, const Column& columns) {
  double low = 0, high = 0;
  for (const auto& run : runs)
    for (const auto& column : columns(run))
      for (double x : column) low = std::min(low, x), high = std::max(high, x);
  const double round = std::pow(10, std::floor(std::log10(std::max(factor * (high - low), 1e-30)))) / 2;
  return {round * std::floor(factor * low / round), round * std::ceil(factor * high / round)};
}

std::vector<double> misfit(const MeasuredRun& run, const std::vector<double>& model) {
  std::vector<double> r(model.size());
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = run.measured[i] - model[i];
  return r;
}

/// Two plots of a run, on the scales of all: force over motion, what is left over time.
std::string run_html(const Findings& findings, std::size_t index, const Unit& unit, const Json& forces, const Json& depths, const Json& rests) {
  const MeasuredRun& run = findings.runs[index];
  const bool stress = findings.report.value("unit", "N") == "MPa";
  const std::string quantity = (stress ? "stress (" : "force (") + unit.name + ")", id = "plot-run-" + std::to_string(index);
  const Json curves = {{"kind", "lines"}, {"x", findings.report.value("motion", "")}, {"y", quantity}, {"x_range", depths}, {"y_range", forces},
                       {"series", {{{"name", "measured"}, {"style", "marks"}, {"points", points(run.u, run.measured, unit.factor)}},
                                   {{"name", "before"}, {"style", "line"}, {"points", points(run.u, run.before, unit.factor)}},
                                   {{"name", "after"}, {"style", "line"}, {"points", points(run.u, run.after, unit.factor)}}}}};
  const std::vector<double> up(run.t.size(), run.noise), down(run.t.size(), -run.noise);
  const Json rest = {{"kind", "lines"}, {"x", "time (s)"}, {"y", "measured − model (" + unit.name + ")"}, {"y_range", rests},
                     {"series", {{{"name", "noise, one sd"}, {"style", "band"}, {"points", points(run.t, up, unit.factor)}},
                                 {{"name", "before"}, {"style", "line"}, {"points", points(run.t, misfit(run, run.before), unit.factor)}},
                                 {{"name", "after"}, {"style", "line"}, {"points", points(run.t, misfit(run, run.after), unit.factor)}},
                                 {{"name", ""}, {"style", "band"}, {"points", points(run.t, down, unit.factor)}}}}};
  return "<h3>" + escaped(run.name) + " <span class=\"soft\">" + (run.role == "holdout" ? "sealed" : escaped(run.role)) + "</span></h3>\n<div class=\"pair\">" +
         plot_figure(id, curves, "Measured and fitted curves of run " + run.name, "plot low") +
         plot_figure(id + "-rest", rest, "What the models leave of run " + run.name + ", with the noise band", "plot low") + "</div>\n";
}

std::string curves_html(const Findings& findings) {
  const Unit unit = unit_of(findings);
  using Columns = std::vector<std::vector<double>>;
  const Json forces = range(findings.runs, unit.factor, [](const MeasuredRun& r) { return Columns{r.measured, r.before, r.after}; });
  const Json depths = range(findings.runs, 1, [](const MeasuredRun& r) { return Columns{r.u}; });
  const Json rests = range(findings.runs, unit.factor, [](const MeasuredRun& r) { return Columns{misfit(r, r.before), misfit(r, r.after)}; });
  std::string html = "<p class=\"hint\">All runs on one scale. Left: marks are measured, lines are the model without and with the effects named. "
                     "Right: what each leaves, over time; the band is one standard deviation of the noise.</p>\n";
  for (std::size_t i = 0; i < findings.runs.size(); ++i) html += run_html(findings, i, unit, forces, depths, rests);
  return html;
}

std::string table(const std::vector<std::string>& heads, const std::string& rows, std::size_t numeric_from = 1) {
  return wide("<table><thead>" + table_row(heads, "th", numeric_from) + "</thead><tbody>\n" + rows + "</tbody></table>");
}

std::string interval(const Json& pair, int digits = 3) { return number(pair.at(0), digits) + " – " + number(pair.at(1), digits); }

std::string errors_html(const Json& report) {
  std::string rows;
  for (const auto& [role, title] : {std::pair{"fit", "fitted runs"}, std::pair{"holdout", "sealed runs"}})
    for (const char* when : {"before", "after"}) {
      const Json& e = report.at("error").at(when).at(role);
      if (!e.is_object()) continue;
      rows += table_row({std::string(title) + ", " + when, number(e.at("N")), interval(e.at("interval_N")), number(e.at("percent"), 2),
                         number(e.at("times_noise_floor"), 2), number(e.at("runs"))}, "td", 1);
    }
  return table({"error", "root mean square (" + report.value("unit", "N") + ")", "95 % interval", "% of largest", "× noise floor", "runs"}, rows);
}

std::string parameters_html(const Json& report) {
  std::map<std::string, const Json*> before;
  for (const Json& p : report.at("parameters_before")) before[p.at("name").get<std::string>()] = &p;
  std::string rows;
  for (const Json& p : report.at("parameters")) {
    const auto old = before.find(p.at("name").get<std::string>());
    rows += table_row({escaped(p.at("name").get<std::string>()), escaped(p.at("unit").get<std::string>()), escaped(p.at("source").get<std::string>()),
                       old == before.end() ? "–" : number(old->second->at("value")), number(p.at("value")), interval(p.at("interval")), interval(p.at("range"))},
                      "td", 3);
  }
  return table({"parameter", "unit", "from", "before", "after", "95 % interval", "range allowed"}, rows, 3);
}

/// Rows of the residual table grouped by `by`, before and after side by side.
std::string residual_rows(const Json& report, const std::string& by) {
  std::string rows;
  const Json &before = report.at("residuals").at("before"), &after = report.at("residuals").at("after");
  for (std::size_t i = 0; i < before.size() && i < after.size(); ++i)
    if (before[i].at("by") == by)
      rows += table_row({escaped(by) + ": " + escaped(before[i].at("name").get<std::string>()), number(before[i].at("blocks"), 6), number(before[i].at("rms_N")),
                         number(after[i].at("rms_N")), number(before[i].at("chi2_per_block")), number(after[i].at("chi2_per_block")),
                         number(before[i].at("lag1"), 2), number(after[i].at("lag1"), 2)}, "td", 1);
  return rows;
}

std::string residuals_html(const Json& report) {
  const std::vector<std::string> heads{"where", "blocks", "misfit before (" + report.value("unit", "N") + ")", "after", "χ² per block before", "after",
                                       "correlation with next before", "after"};
  std::string rows;
  for (const char* by : {"phase", "depth", "rate", "cycle"}) rows += residual_rows(report, by);
  return table(heads, rows) + "<details><summary>By run and phase</summary>\n" + table(heads, residual_rows(report, "run and phase")) + "</details>\n";
}

std::string candidates_html(const Json& report) {
  std::string tried, others;
  for (const Json& c : report.at("candidates")) {
    const bool refitted = c.value("refitted", false);
    const std::string unit = c.value("unit", "");
    const std::vector<std::string> cells{escaped(c.at("effect").get<std::string>()), escaped(c.at("reason").get<std::string>()), number(c.at("step")),
                                         number(c.value("z", Json()), 2), number(c.value("lambda", Json())), number(c.value("p", Json()), 2),
                                         number(c.value("amplitude", Json())) + (unit == "1" ? "" : " " + escaped(unit))};
    std::string row = table_row(cells, "td", 2);
    (refitted ? tried : others) += c.at("reason") == "taken" ? "<tr class=\"taken\">" + row.substr(4) : row;
  }
  const std::vector<std::string> heads{"effect", "what became of it", "step", "z", "Λ", "p", "amplitude"};
  return "<p class=\"hint\">z: how well its shape fits what is left, with the sign of its amplitude; Λ: twice the gain in log-likelihood after a refit of everything; "
         "p: of its own null distribution.</p>\n" +
         table(heads, tried, 2) + "<details><summary>Candidates that were not refitted</summary>\n" + table(heads, others, 2) + "</details>\n";
}

std::string blind_spots_html(const Json& report) {
  std::string rows;
  for (const Json& b : report.at("blind_spots")) {
    std::string like;
    for (const Json& name : b.value("cannot_be_told_from", Json::array())) like += (like.empty() ? "" : ", ") + name.get<std::string>();
    rows += table_row({escaped(b.at("effect").get<std::string>()), b.value("visible", false) ? "visible" : escaped(b.value("told", "")), escaped(like),
                       escaped(b.value("unit", "")), number(b.value("smallest_visible", Json())), number(b.value("largest_plausible", Json()))}, "td", 4);
  }
  return table({"effect", "", "cannot be told from", "unit", "smallest amplitude this protocol shows", "largest plausible"}, rows, 4);
}

std::string next_html(const Json& report) {
  const Json next = report.value("next_experiment", Json());
  if (!next.is_object()) return "";
  return "<p><b>" + escaped(next.value("run", "")) + "</b> – " + escaped(next.value("why", "")) + ".</p>\n";
}

/// Of a law that was open: what each leaves, and all on the first loading of one run.
std::string laws_html(const Findings& findings) {
  const Json laws = findings.report.value("laws_tried", Json::array());
  if (laws.empty()) return "";
  const Unit unit = unit_of(findings);
  const std::string chosen = findings.report.value("law", ""), run = laws.front().value("run", "");
  std::string rows;
  Json series = Json::array();
  for (const MeasuredRun& measured : findings.runs)
    if (measured.name == run) {
      const auto n = static_cast<std::ptrdiff_t>(laws.front().at("first_loading").size());
      const std::vector<double> u(measured.u.begin(), measured.u.begin() + n), force(measured.measured.begin(), measured.measured.begin() + n);
      series.push_back({{"name", "measured"}, {"style", "marks"}, {"points", points(u, force, unit.factor)}});
    }
  for (const Json& law : laws) {
    const std::string name = law.at("law").get<std::string>(), row = table_row({escaped(name), number(law.at("percent"), 2), number(law.at("left_out_excess"), 3)}, "td", 1);
    rows += name == chosen ? "<tr class=\"taken\">" + row.substr(4) : row;
    Json curve = Json::array();
    for (const Json& point : law.at("first_loading")) curve.push_back({point.at(0), unit.factor * point.at(1).get<double>()});
    series.push_back({{"name", name}, {"style", "line"}, {"points", curve}});
  }
  const Json plot = {{"kind", "lines"}, {"x", findings.report.value("motion", "")}, {"y", "force (" + unit.name + ")"}, {"series", series}};
  return "<p class=\"hint\">The law was left open. Each is fitted to all runs; the one that predicts runs left out best is kept, and what it still misses is what follows. "
         "The plot shows the first loading of run " + escaped(run) + ".</p>\n" +
         plot_figure("plot-laws", plot, "Laws fitted to the first loading of run " + run, "plot") + table({"law", "error, % of the largest force", "excess on runs left out"}, rows);
}

std::string remarks_html(const Json& report) {
  std::string items;
  for (const Json& remark : report.value("remarks", Json::array())) items += "<li>" + escaped(remark.is_string() ? remark.get<std::string>() : remark.dump()) + "</li>\n";
  return items.empty() ? "" : "<ul class=\"hint\">\n" + items + "</ul>\n";
}

std::string kind_of(const Json& report) {
  const std::string kind = report.at("verdict").at("kind").get<std::string>();
  const auto words = verdicts().find(kind);
  return words == verdicts().end() ? kind : words->second;
}

std::string head_html(const Json& report) {
  return "<header class=\"top\">\n<p class=\"kind\">Palpate loop · " + escaped(kind_of(report)) + "</p>\n<h1>" +
         escaped(report.value("specimen", "")) + ", " + escaped(report.value("law", "")) + "</h1>\n<p class=\"lead\">" +
         escaped(report.at("verdict").at("sentence").get<std::string>()) + "</p>\n" + tiles_html(report) + "</header>\n";
}

/// Calls `make`; what the report lacks is told as a failure.
template <class Make>
std::string guarded(const Make& make) {
  try {
    return make();
  } catch (const Json::exception& error) {
    throw Failure(ExitCode::unreadable, std::string("the loop's report lacks something: ") + error.what(), "report.json", "run palpate-loop again");
  }
}

}  // namespace

std::string verdict_html(const Findings& findings) {
  return guarded([&] {
    return "<p class=\"lead\">" + escaped(findings.report.at("verdict").at("sentence").get<std::string>()) + "</p>\n" + tiles_html(findings.report) +
           curves_html(findings) + candidates_html(findings.report);
  });
}

std::string loop_page_html(const Findings& findings) {
  const Json& report = findings.report;
  return guarded([&] {
    const std::string laws = laws_html(findings);
    const std::string body =
        (laws.empty() ? "" : section("laws", "The law", laws)) + section("curves", "Measured and fitted", curves_html(findings)) + section("errors", "Error before and after", errors_html(report)) +
        section("parameters", "Parameters", parameters_html(report)) + section("residuals", "Where the misfit lives", residuals_html(report)) +
        section("candidates", "Candidates", candidates_html(report)) + section("blind", "What this protocol cannot see", blind_spots_html(report)) +
        section("next", "Next experiment", next_html(report)) + section("remarks", "Remarks on the set", remarks_html(report)) +
        section("noise", "Noise", facts_html(report.at("noise")));
    return whole_page(report.value("specimen", "loop") + ": what the model lacks", head_html(report), body, report.value("version", "unknown"));
  });
}

}  // namespace palpate
