// A CSV table whose header names columns and units: `t[s],u[mm],F[N]`.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace palpate::loop {

struct CsvTable {
  std::filesystem::path file;
  std::map<std::string, std::string> unit;               ///< by column name; empty for text
  std::map<std::string, std::vector<std::string>> text;  ///< every cell
  std::vector<int> line;                                 ///< of each row
  bool has(const std::string& column) const { return unit.contains(column); }
  /// Numbers of a column; "nan" is a number here. Throws Failure(unreadable) with file and line for a missing column (naming those
  /// there are), another unit, or a cell that is no number.
  std::vector<double> numbers(const std::string& column, const std::string& unit) const;
};

/// Throws Failure(unreadable): no such file, no header, a row of another length, no rows.
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace palpate::loop
