// Stages speak for themselves on stderr; "current" alone on stdout means that nothing had to be done.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/study/run.hpp>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iterator>

#include <palpate/errors.hpp>
#include <pipeline/study/process.hpp>
#include <pipeline/study/record.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

void fail_unless_done(const StageCall& call, const ProcessResult& process) {
  if (process.signal != 0)
    throw Failure(ExitCode::defect, "the stage " + call.name + " was ended by a signal: " + strsignal(process.signal), call.where,
                  process.signal == 9 ? "perhaps memory ran out: a coarser mesh or scan" : "please report it with the study");
  if (process.code != 0)
    throw Failure(static_cast<ExitCode>(process.code), "the stage " + call.name + " failed with exit code " + std::to_string(process.code) + " (its message is above)",
                  call.where);
}

/// A seed of the section wins over the common one.
std::vector<std::string> all_arguments(const StageCall& call, const std::vector<std::string>& common) {
  const auto is_seed = [](const std::string& word) { return word.starts_with("--seed="); };
  std::vector<std::string> words = call.arguments;
  const bool has_seed = std::any_of(words.begin(), words.end(), is_seed);
  std::copy_if(common.begin(), common.end(), std::back_inserter(words), [&](const std::string& word) { return !(has_seed && is_seed(word)); });
  return words;
}

}  // namespace

void run_study(const StudyPlan& plan, const fs::path& result, const Programs& programs, const std::vector<std::string>& common,
               const std::function<void(const StageReport&)>& tell) {
  for (std::size_t i = 0; i < plan.calls.size(); ++i) {
    const StageCall& call = plan.calls[i];
    for (const fs::path& output : call.outputs) fs::create_directories((result / output).parent_path());
    if (call.stage == "report") write_study_record(result / "study.json", plan);
    const std::vector<std::string> arguments = all_arguments(call, common);
    const auto start = std::chrono::steady_clock::now();
    const ProcessResult process = run_process(programs.path(call.stage), arguments);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fail_unless_done(call, process);
    const bool current = process.output == "current\n";
    tell({call, i + 1, plan.calls.size(), current ? StageOutcome::current : StageOutcome::made, seconds, current ? "" : process.output});
  }
  write_study_record(result / "study.json", plan);
}

}  // namespace palpate
