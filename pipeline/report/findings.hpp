// A loop folder as the report sees it: the verdict and the curves behind it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <palpate/json.hpp>

namespace palpate {

/// A run as measured and as two models say, block by block; all columns of one length ≥ 1.
struct MeasuredRun {
  std::string name, role;  ///< role: fit, holdout or calibration
  std::vector<std::string> phases;
  std::vector<double> t, u, measured, before, after;
  double noise = 0;  ///< one standard deviation
};

struct Findings {
  Json report;  ///< report.json
  std::vector<MeasuredRun> runs;
  std::vector<std::filesystem::path> files_read;
};

/// True where palpate-loop run has left its report.
bool is_loop_folder(const std::filesystem::path& folder);

/// Throws Failure(unreadable) naming file and line when report.json or curves.csv is damaged.
Findings read_findings(const std::filesystem::path& folder);

}  // namespace palpate
