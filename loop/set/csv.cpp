// Reading CSV with units in its header.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/set/csv.hpp>

#include <charconv>
#include <sstream>

#include <palpate/errors.hpp>
#include <palpate/text_file.hpp>

namespace palpate::loop {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line + ",");
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(trimmed(cell));
  return cells;
}

[[noreturn]] void unreadable(const std::filesystem::path& file, int line, const std::string& what, const std::string& next = "") {
  throw Failure(ExitCode::unreadable, what, file.string() + ":" + std::to_string(line), next);
}

/// "F[N]" → name F and unit N.
std::vector<std::string> read_header(CsvTable& table, const std::string& line, int number) {
  std::vector<std::string> names;
  for (const char other : {';', '\t'})
    if (line.find(other) != std::string::npos)
      unreadable(table.file, number, std::string("columns are parted by commas here, and the header has ") + (other == ';' ? "semicolons" : "tabs"), "commas between columns, points in numbers: t[s],u[mm],F[N]");
  for (const std::string& cell : cells_of(line)) {
    const auto open = cell.find('['), close = cell.find(']');
    const bool has_unit = open != std::string::npos && close != std::string::npos && close > open;
    const std::string name = has_unit ? trimmed(cell.substr(0, open)) : cell;
    if (!table.unit.emplace(name, has_unit ? cell.substr(open + 1, close - open - 1) : "").second)
      unreadable(table.file, number, "two columns are called " + name);
    names.push_back(name);
  }
  return names;
}

}  // namespace

CsvTable read_csv(const std::filesystem::path& path) {
  CsvTable table;
  table.file = path;
  std::istringstream in(read_text(path));
  std::vector<std::string> names;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    if (names.empty()) {
      names = read_header(table, line, number);
      continue;
    }
    const auto cells = cells_of(line);
    if (cells.size() != names.size())
      unreadable(path, number, std::to_string(cells.size()) + " cells in a row of a table with " + std::to_string(names.size()) + " columns", "as many cells as the header has; a decimal comma counts as two");
    for (std::size_t i = 0; i < names.size(); ++i) table.text[names[i]].push_back(cells[i]);
    table.line.push_back(number);
  }
  if (table.line.empty()) unreadable(path, std::max(number, 1), "no measurements", "a header t[s],u[mm],F[N] and one row per sample");
  return table;
}

std::vector<double> CsvTable::numbers(const std::string& column, const std::string& wanted) const {
  const std::string full = column + "[" + wanted + "]";
  if (!has(column)) {
    std::string there;
    for (const auto& [name, its_unit] : unit) there += (there.empty() ? "" : ", ") + name + (its_unit.empty() ? "" : "[" + its_unit + "]");
    unreadable(file, 1, "missing column: " + full + "; there are " + there, "name it with its unit in the header");
  }
  if (unit.at(column) != wanted)
    unreadable(file, 1, "column " + column + " is in [" + unit.at(column) + "], where [" + wanted + "] is read", "convert the numbers and write " + full);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::string& cell = text.at(column)[i];
    double x = 0;
    const auto [end, error] = std::from_chars(cell.data() + (cell.starts_with('+') ? 1 : 0), cell.data() + cell.size(), x);
    if (error != std::errc() || end != cell.data() + cell.size()) unreadable(file, line[i], "no number in column " + full + ": \"" + cell + "\"");
    numbers.push_back(x);
  }
  return numbers;
}

}  // namespace palpate::loop
