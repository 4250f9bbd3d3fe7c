// Results side by side: one row per quantity, one column per result; series over a quantity, and another source's growths beside ours.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/json.hpp>
#include <pipeline/compare/measures.hpp>

namespace palpate {

/// A growth that somebody else reports of a series, in percent, from one value of the quantity it is drawn over to another.
struct Reported {
  std::string quantity, series;
  double from = 0, to = 0, percent = 0;
};
struct Beside {
  std::string source;
  std::vector<Reported> growths;
};
/// Throws Failure(misuse) with file and line.
Beside read_beside(const std::filesystem::path& path);

/// The folders with a history: those given, and in a study's folder those of its solves, by name. Each with a name that no other has.
/// Throws Failure(unreadable) for a folder with neither, Failure(misuse) for one given twice.
std::vector<std::pair<std::string, std::filesystem::path>> named_results(const std::vector<std::filesystem::path>& folders);

/// compare.json. `over`: a quantity along which results of one series ("wall" of "wall-0.8") are points; empty: none. Throws
/// Failure(misuse) for a quantity that no result has, or a growth that no results stand for.
Json side_by_side(const std::vector<Measured>& results, const std::string& over, const std::optional<Beside>& beside);

/// Of compare.json: its rows, and its curves one under the other.
std::string rows_csv(const Json& comparison);
std::string curves_csv(const Json& comparison);

}  // namespace palpate
