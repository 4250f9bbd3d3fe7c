// A planned study carried out: stage after stage, each skipped by itself when its card is current.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <pipeline/study/chain.hpp>
#include <pipeline/study/programs.hpp>

namespace palpate {

enum class StageOutcome { made, current };

struct StageReport {
  const StageCall& call;
  std::size_t number, count;  ///< 1 … count
  StageOutcome outcome;
  double seconds;
  std::string results;  ///< what the stage wrote to stdout
};

/// Runs the calls in order, `common` words added to each (--quiet, --threads=2, --skip-current). study.json is written before the report
/// and at the end. The first stage that fails ends the run: Failure with the stage's exit code, naming its section.
void run_study(const StudyPlan& plan, const std::filesystem::path& result, const Programs& programs, const std::vector<std::string>& common,
               const std::function<void(const StageReport&)>& tell);

}  // namespace palpate
