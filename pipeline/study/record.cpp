// Cards lie beside the first output of a stage.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/study/record.hpp>

#include <palpate/card.hpp>
#include <palpate/outputs.hpp>
#include <palpate/text_file.hpp>

namespace palpate {
namespace fs = std::filesystem;

Json study_record(const StudyPlan& plan) {
  Json stages = Json::array();
  for (const StageCall& call : plan.calls) {
    const std::string output = call.outputs.front().generic_string();
    Json outputs = Json::array();
    for (const fs::path& path : call.outputs) outputs.push_back(path.generic_string());
    for (const std::string& path : call.side_outputs) outputs.push_back(path);
    stages.push_back({{"name", call.name}, {"stage", call.stage}, {"output", output}, {"outputs", outputs}, {"card", card_path(output).generic_string()}});
  }
  return {{"schema", "palpate-study-record/1"}, {"title", plan.title}, {"stages", stages}};
}

void write_study_record(const fs::path& path, const StudyPlan& plan) {
  const Json record = study_record(plan);
  if (fs::exists(path) && read_text(path) == record.dump(2) + "\n") return;
  PendingOutput pending(path, PendingOutput::Kind::file, true);
  write_text(pending.temporary(), record.dump(2) + "\n");
  pending.commit();
}

}  // namespace palpate
