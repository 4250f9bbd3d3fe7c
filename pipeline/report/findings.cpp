// report.json and curves.csv; docs/formats.md tells their form.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/findings.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

constexpr const char* again = "run palpate-loop again";

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> list;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) list.push_back(cell);
  return list;
}

double number(const std::string& text, const std::string& where) {
  std::size_t used = 0;
  double x = NAN;
  try {
    x = std::stod(text, &used);
  } catch (const std::exception&) {
  }
  if (used != text.size() || !std::isfinite(x)) throw Failure(ExitCode::unreadable, "not a finite number: " + text, where, again);
  return x;
}

std::vector<MeasuredRun> read_curves(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line) || cells(line).size() != 9) throw Failure(ExitCode::unreadable, "no table of curves", path.string() + ":1", again);
  std::vector<MeasuredRun> runs;
  for (int at = 2; std::getline(in, line); ++at) {
    const std::string where = path.string() + ":" + std::to_string(at);
    const auto c = cells(line);
    if (c.size() != 9) throw Failure(ExitCode::unreadable, "a line of " + std::to_string(c.size()) + " cells instead of 9", where, again);
    const double noise = number(c[8], where);
    if (runs.empty() || runs.back().name != c[0]) runs.push_back({c[0], c[1], {}, {}, {}, {}, {}, {}, noise});
    MeasuredRun& run = runs.back();
    run.phases.push_back(c[2]);
    std::vector<double>* const columns[] = {&run.t, &run.u, &run.measured, &run.before, &run.after};
    for (std::size_t k = 0; k < 5; ++k) columns[k]->push_back(number(c[3 + k], where));
  }
  if (runs.empty()) throw Failure(ExitCode::unreadable, "no run", path.string(), again);
  return runs;
}

}  // namespace

bool is_loop_folder(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "report.json") && std::filesystem::exists(folder / "curves.csv");
}

Findings read_findings(const std::filesystem::path& folder) {
  const auto report = folder / "report.json", curves = folder / "curves.csv";
  Findings findings;
  findings.files_read = {report, curves};
  std::ifstream in(report);
  findings.report = Json::parse(in, nullptr, false);
  if (!findings.report.is_object() || findings.report.value("schema", "") != "palpate-loop-report/1")
    throw Failure(ExitCode::unreadable, "not a report of palpate-loop", report.string(), again);
  findings.runs = read_curves(curves);
  return findings;
}

}  // namespace palpate
