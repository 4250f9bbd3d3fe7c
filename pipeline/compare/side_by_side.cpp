// Rows in the order in which results bring them; a quantity one result lacks is null there.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/compare/side_by_side.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <regex>
#include <sstream>

#include <palpate/errors.hpp>
#include <palpate/nearest.hpp>
#include <palpate/settings.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

const Measure* find(const Measured& result, const std::string& quantity) {
  for (const Measure& m : result.measures)
    if (m.quantity == quantity) return &m;
  return nullptr;
}

/// Every quantity once: by group, then as results have them.
std::vector<const Measure*> quantities(const std::vector<Measured>& results) {
  std::vector<const Measure*> all;
  for (const char* group : {"geometry", "mesh", "maxima", "trust"})
    for (const Measured& result : results)
      for (const Measure& m : result.measures)
        if (m.group == group && std::none_of(all.begin(), all.end(), [&](const Measure* known) { return known->quantity == m.quantity; })) all.push_back(&m);
  return all;
}

Json rows(const std::vector<Measured>& results) {
  Json list = Json::array();
  for (const Measure* row : quantities(results)) {
    Json values = Json::array(), change = Json::array();
    for (const Measured& result : results) {
      const Measure *m = find(result, row->quantity), *first = find(results.front(), row->quantity);
      values.push_back(m ? finite_or_null(m->value) : Json());
      change.push_back(m && first && first->value != 0 ? finite_or_null(100 * (m->value / first->value - 1)) : Json());
    }
    list.push_back({{"group", row->group}, {"quantity", row->quantity}, {"unit", row->unit}, {"values", values}, {"change_percent", change}});
  }
  return list;
}

/// "wall-0.8" and "wall-2" are of the series "wall"; what has no number at its end is a series of its own.
std::string series_of(const std::string& name) {
  static const std::regex numbered("^(.+)[-_][0-9]+(\\.[0-9]+)?$");
  std::smatch match;
  return std::regex_match(name, match, numbered) ? match[1].str() : name;
}

struct Point {
  double x = 0;
  const Measured* result = nullptr;
};
std::map<std::string, std::vector<Point>> series(const std::vector<Measured>& results, const std::string& over) {
  std::map<std::string, std::vector<Point>> all;
  for (const Measured& result : results)
    if (const Measure* x = find(result, over)) all[series_of(result.name)].push_back({x->value, &result});
  for (auto& [name, points] : all)
    std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  return all;
}

double value_at(const std::vector<Point>& points, double x, const Reported& growth) {
  for (const Point& p : points)
    if (std::abs(p.x - x) <= 1e-6 * std::max(1.0, std::abs(x)))
      if (const Measure* m = find(*p.result, growth.quantity)) return m->value;
  std::ostringstream what;
  what << "no result of the series " << growth.series << " has " << growth.quantity << " at " << x;
  throw Failure(ExitCode::misuse, what.str(), "--beside", "compare the results it speaks of");
}

Json beside_json(const std::map<std::string, std::vector<Point>>& all, const Beside& beside) {
  Json growths = Json::array();
  for (const Reported& g : beside.growths) {
    const auto found = all.find(g.series);
    if (found == all.end()) throw Failure(ExitCode::misuse, "no results of the series " + g.series, "--beside", "results named " + g.series + "-<number>");
    const double first = value_at(found->second, g.from, g), last = value_at(found->second, g.to, g);
    growths.push_back({{"series", g.series}, {"quantity", g.quantity}, {"from", g.from}, {"to", g.to}, {"theirs_percent", g.percent},
                       {"ours_percent", finite_or_null(100 * (last / first - 1))}});
  }
  return {{"source", beside.source}, {"growths", growths}};
}

Json curves(const std::vector<Measured>& results) {
  Json list = Json::array();
  for (const Measured& result : results) {
    Json curve = {{"result", result.name}};
    for (const auto& [key, column] : {std::pair{"t_s", "t[s]"}, std::pair{"depth_mm", "depth[mm]"}, std::pair{"force_N", "F[N]"}, std::pair{"contact_area_mm2", "contact_area[mm2]"}})
      if (const auto& values = result.solve.history.column(column); !values.empty()) curve[key] = values;
    list.push_back(curve);
  }
  return list;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

}  // namespace

Beside read_beside(const fs::path& path) {
  const Settings settings = Settings::read(path);
  if (settings.text("schema") != "palpate-beside/1")
    throw Failure(ExitCode::misuse, "not growths that somebody reports", settings.where("schema"), "schema = \"palpate-beside/1\"");
  Beside beside{settings.text("source"), {}};
  for (const Settings& g : settings.tables("growth"))
    beside.growths.push_back({g.text("quantity"), g.text("series"), g.real("from"), g.real("to"), g.real("percent")});
  settings.expect_all_read();
  return beside;
}

std::vector<std::pair<std::string, fs::path>> named_results(const std::vector<fs::path>& folders) {
  std::vector<std::pair<std::string, fs::path>> results;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> found;
    if (fs::is_regular_file(folder / "history.csv")) found.push_back(folder);
    else if (fs::is_directory(folder / "solve"))
      for (const auto& entry : fs::directory_iterator(folder / "solve"))
        if (fs::is_regular_file(entry.path() / "history.csv")) found.push_back(entry.path());
    if (found.empty())
      throw Failure(ExitCode::unreadable, "neither a result (history.csv) nor a study with results (solve/*/history.csv)", folder.string(), "give what palpate-solve or palpate run made");
    std::sort(found.begin(), found.end());
    for (const fs::path& path : found) results.emplace_back(fs::absolute(path).lexically_normal().filename().string(), path);
  }
  std::map<std::string, int> count;
  for (const auto& [name, path] : results) ++count[name];
  for (auto& [name, path] : results)
    if (count[name] > 1) name = path.generic_string();
  for (const auto& [name, path] : results)
    if (std::count_if(results.begin(), results.end(), [&](const auto& other) { return fs::equivalent(other.second, path); }) > 1)
      throw Failure(ExitCode::misuse, "given twice", path.string(), "name each result once");
  return results;
}

Json side_by_side(const std::vector<Measured>& results, const std::string& over, const std::optional<Beside>& beside) {
  Json comparison = {{"schema", "palpate-compare/1"}, {"results", Json::array()}, {"rows", rows(results)}, {"over", nullptr}, {"beside", nullptr}, {"curves", curves(results)},
                     {"diameters", Json::array()}};
  for (const Measured& result : results) {
    comparison["results"].push_back(result.name);
    if (!result.arc_mm.empty()) comparison["diameters"].push_back({{"result", result.name}, {"arc_mm", result.arc_mm}, {"diameter_mm", result.diameter_mm}});
  }
  if (over.empty() && beside) throw Failure(ExitCode::misuse, "growths are told from one value to another of a quantity, and none is given", "--beside", "--over thickness");
  if (over.empty()) return comparison;
  const auto all = series(results, over);
  if (all.empty()) {
    std::vector<std::string> known;
    for (const Measure* m : quantities(results)) known.push_back(m->quantity);
    throw Failure(ExitCode::misuse, "no result has the quantity " + over, "--over", "did you mean " + nearest_name(over, known) + "?");
  }
  comparison["over"] = {{"quantity", over}, {"unit", find(*all.begin()->second.front().result, over)->unit}, {"series", Json::array()}};
  for (const auto& [name, points] : all) {
    Json members = Json::array(), at = Json::array();
    for (const Point& p : points) members.push_back(p.result->name), at.push_back(p.x);
    comparison["over"]["series"].push_back({{"name", name}, {"at", at}, {"results", members}});
  }
  if (beside) comparison["beside"] = beside_json(all, *beside);
  return comparison;
}

std::string rows_csv(const Json& comparison) {
  std::ostringstream out;
  out << std::setprecision(12) << "group,quantity,unit";
  for (const Json& name : comparison.at("results")) out << ',' << quoted(name.get<std::string>());
  out << '\n';
  for (const Json& row : comparison.at("rows")) {
    out << row.at("group").get<std::string>() << ',' << quoted(row.at("quantity").get<std::string>()) << ',' << row.at("unit").get<std::string>();
    for (const Json& value : row.at("values")) {
      out << ',';
      if (value.is_number()) out << value.get<double>();
    }
    out << '\n';
  }
  return out.str();
}

std::string curves_csv(const Json& comparison) {
  std::ostringstream out;
  out << std::setprecision(12) << "result,t[s],depth[mm],F[N],contact_area[mm2]\n";
  for (const Json& curve : comparison.at("curves"))
    for (std::size_t i = 0; i < curve.at("t_s").size(); ++i) {
      out << quoted(curve.at("result").get<std::string>()) << ',' << curve.at("t_s")[i].get<double>() << ',' << curve.at("depth_mm")[i].get<double>() << ','
          << curve.at("force_N")[i].get<double>() << ',';
      if (curve.contains("contact_area_mm2")) out << curve["contact_area_mm2"][i].get<double>();
      out << '\n';
    }
  return out.str();
}

}  // namespace palpate
