// Comma-separated numbers under a header.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/history.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include <palpate/errors.hpp>
#include <palpate/text_file.hpp>

namespace palpate {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream in(line);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

[[noreturn]] void damaged(const std::filesystem::path& path, std::size_t line, const std::string& what) {
  throw Failure(ExitCode::unreadable, what, path.string() + ", line " + std::to_string(line),
                "run palpate-solve again; it writes this file");
}

double finite_number(const std::string& word, const std::string& column, const std::filesystem::path& path, std::size_t line) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
    damaged(path, line, column + " is not a finite number: \"" + word + "\"");
  return value;
}

}  // namespace

const std::vector<double>& History::column(const std::string& name) const {
  static const std::vector<double> none;
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? none : columns[found - names.begin()];
}

History read_history(const std::filesystem::path& path) {
  std::istringstream lines(read_text(path));
  std::string line;
  if (!std::getline(lines, line)) damaged(path, 1, "the history is empty");
  History history{split(line), {}};
  history.columns.resize(history.names.size());
  for (std::size_t number = 2; std::getline(lines, line); ++number) {
    const auto words = split(line);
    if (words.size() != history.names.size())
      damaged(path, number,
              std::to_string(words.size()) + " numbers under " + std::to_string(history.names.size()) + " column names");
    for (std::size_t c = 0; c < words.size(); ++c)
      history.columns[c].push_back(finite_number(words[c], history.names[c], path, number));
  }
  for (const char* needed : {"t[s]", "depth[mm]", "F[N]"})
    if (history.column(needed).empty()) damaged(path, 1, std::string("no values of ") + needed);
  return history;
}

}  // namespace palpate
