// palpate: runs a study's stages in order, lists what all programs offer, and is the short way to every stage.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/nearest.hpp>
#include <pipeline/study/chain.hpp>
#include <pipeline/study/process.hpp>
#include <pipeline/study/programs.hpp>
#include <pipeline/study/run.hpp>

#include <iomanip>
#include <sstream>

using namespace palpate;
namespace fs = std::filesystem;

namespace {

void usage_of_run(Usage& u) {
  u.name = "run";
  u.sentence = "Runs the stages of a study in order, skips those that are current, and stops at the first that fails.";
  u.details =
      "A study is TOML with schema = \"palpate-study/1\", a title and sections [phantom], [import], [segment], [surface], [mesh], [[solve]], [report]: "
      "those that are present run. A key is an option of the stage, '-' written '_'; input = \"file\" replaces what the stage before makes. "
      "A stage is current when the card beside its output says that this very call made it from these very bytes; --force runs every stage. "
      "The last line on stdout is the page, if there is one.";
  u.input("study", "study.toml", "the study; paths in it are relative to it");
  u.text("out", {}, "folder for everything that is made; default: the folder \"result\" beside the study");
  u.text("dicom", {}, "DICOM folder that [import] reads instead of what the study says; [phantom] is left out");
}

std::string progress_line(const StageReport& r) {
  std::string what = r.call.input.filename().string() + " → ";
  for (const auto& output : r.call.outputs) what += (output == r.call.outputs.front() ? "" : ", ") + output.generic_string();
  std::ostringstream line;
  line << "[" << r.number << "/" << r.count << "] " << std::left << std::setw(20) << r.call.name << " "
       << (r.outcome == StageOutcome::current ? "current" : "done   ") << " " << std::right << std::fixed << std::setprecision(1) << std::setw(7)
       << r.seconds << " s   " << what;
  return line.str();
}

std::vector<std::string> words_for_all_stages(const Command& c) {
  std::vector<std::string> words = {"--force"};
  if (!c.flag("force")) words.push_back("--skip-current");
  for (const char* flag : {"quiet", "verbose"})
    if (c.flag(flag)) words.push_back("--" + std::string(flag));
  if (c.integer("threads") != 0) words.push_back("--threads=" + std::to_string(c.integer("threads")));
  if (c.seed() != 1) words.push_back("--seed=" + std::to_string(c.seed()));
  return words;
}

void run_of_run(Command& c) {
  StudyPlaces places;
  places.study = c.input("study");
  places.result = c.has("out") ? fs::path(c.text("out")) : places.study.parent_path() / "result";
  if (c.has("dicom")) places.dicom = c.text("dicom");
  const Programs programs(own_folder());
  const StudyPlan plan = read_study_plan(places, [&](const std::string& stage) { return programs.ask(stage, "--describe"); });
  run_study(plan, places.result, programs, words_for_all_stages(c), [&](const StageReport& report) {
    c.say(progress_line(report));
    if (c.verbose() && !report.results.empty()) c.say(report.results);
  });
  for (const StageCall& call : plan.calls)
    if (call.stage == "report") c.print((places.result / call.outputs.front()).string());
}

void usage_of_list(Usage& u) {
  u.name = "list";
  u.sentence = "Prints what all programs offer by name: materials, elements, tools, methods, with their parameters.";
  u.flag("json", "print JSON for programs instead of text for people");
}

void run_of_list(Command& c) {
  const Json catalogue = whole_catalogue(Programs(own_folder()));
  c.print(c.flag("json") ? catalogue.dump(2) : catalogue_text(catalogue));
}

/// `palpate segment …` is `palpate-segment …`.
int become_stage(const std::string& word, const std::vector<std::string>& arguments) {
  const Programs programs(own_folder());
  if (programs.has(word)) become_process(programs.path(word), arguments);
  const bool is_option = word.starts_with("-");
  std::vector<std::string> known = {"--help", "--version", "--describe", "--xml", "--catalogue"};
  for (const OptionSpec& option : common_options()) known.push_back("--" + option.name);
  if (!is_option) {
    known = programs.stages();
    known.insert(known.end(), {"run", "list"});
  }
  throw Failure(ExitCode::misuse, (is_option ? "unknown option before a command: " : "unknown command: ") + word, "",
                "did you mean " + nearest_name(word, known) + "? palpate --help lists the commands");
}

}  // namespace

int main(int argc, char** argv) {
  Group group;
  group.program = "palpate";
  group.sentence = "Runs studies from scan to pressed organ, and lists what its programs offer.";
  group.details = "palpate <stage> … is palpate-<stage> …: phantom, import, segment, surface, mesh, solve, report.";
  return run_group(argc, argv, group, {{usage_of_run, run_of_run}, {usage_of_list, run_of_list}}, become_stage);
}
