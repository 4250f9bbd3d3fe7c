// history.csv of a solve: one line per accepted step.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace palpate {

/// Columns by name ("depth[mm]", "F[N]"), all of the same length ≥ 1, all numbers finite.
struct History {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  /// Empty when there is no such column.
  const std::vector<double>& column(const std::string& name) const;
};

/// Throws Failure(unreadable) naming file and line: no header, no step, a line of another length, something that is not a finite
/// number, or no column of time, depth or force.
History read_history(const std::filesystem::path& path);

}  // namespace palpate
