// The chain: phantom → import → segment → surface → mesh → solve… → report.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/study/chain.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <palpate/errors.hpp>
#include <palpate/settings.hpp>
#include <pipeline/study/option_words.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

/// A stage with one input from its predecessor; `writes` in the order of its command line.
struct Link {
  std::string stage, reads;
  std::vector<fs::path> writes;
};

const std::vector<Link>& straight_links() {
  static const std::vector<Link> links = {{"phantom", "", {"dicom", "truth"}},
                                          {"import", "dicom", {"scan.nii.gz"}},
                                          {"segment", "scan.nii.gz", {"labels.nii.gz"}},
                                          {"surface", "labels.nii.gz", {"surface.vtp"}},
                                          {"mesh", "surface.vtp", {"mesh.vtu"}}};
  return links;
}

/// A file or folder that a section names.
fs::path named_path(const Settings& section, const std::string& key, const fs::path& base) {
  const fs::path path = (base / section.text(key)).lexically_normal();
  if (!fs::exists(path)) throw Failure(ExitCode::unreadable, "no such file or folder: " + path.string(), section.where(key), "paths are relative to the study file");
  return path;
}

/// labels.nii.gz and ".sheet.png" → labels.sheet.png, as the stages name them.
std::string side_name(const fs::path& output, const std::string& suffix) {
  const std::string name = output.filename().string();
  const std::string stem = name.ends_with(".nii.gz") ? name.substr(0, name.size() - 7) : fs::path(name).stem().string();
  return (output.parent_path() / (stem + suffix)).generic_string();
}

class Planner {
 public:
  Planner(const StudyPlaces& places, const DescribeFunction& describe)
      : places_(places), describe_(describe), root_(Settings::read(places.study)), base_(places.study.parent_path()) {}

  StudyPlan plan() {
    root_.choice("schema", {"palpate-study/1"});
    plan_.title = root_.text("title");
    for (const Link& link : straight_links()) root_.has(link.stage);
    for (const char* section : {"solve", "report"}) root_.has(section);
    root_.expect_all_read();  // a misspelt section, before its absence is missed
    for (const Link& link : straight_links()) add_link(link);
    for (const Settings& section : root_.tables("solve")) add_solve(section);
    if (root_.has("report")) add_report(root_.table("report"));
    if (places_.dicom && !root_.has("import")) throw Failure(ExitCode::misuse, "--dicom is given, but the study has no [import]", places_.study.string(), "add [import]");
    if (plan_.calls.empty()) throw Failure(ExitCode::misuse, "the study has no stages", places_.study.string(), "[import], [segment], …");
    return std::move(plan_);
  }

 private:
  void add_link(const Link& link) {
    if (!root_.has(link.stage) || (link.stage == "phantom" && places_.dicom)) return;
    const Settings section = root_.table(link.stage);
    add(link.stage, link.stage, section, input_of(link, section), link.writes, {"input"}, {});
  }

  fs::path input_of(const Link& link, const Settings& section) const {
    if (link.stage == "import" && places_.dicom) return *places_.dicom;
    if (section.has("input")) return named_path(section, "input", base_);
    if (made_.contains(link.reads)) return places_.result / link.reads;
    std::string maker;
    for (const Link& other : straight_links())
      for (const fs::path& output : other.writes)
        if (output == link.reads) maker = other.stage;
    throw Failure(ExitCode::misuse, "[" + link.stage + "] has nothing to read" + (maker.empty() ? "" : ": there is no [" + maker + "] before it"),
                  section.where(), "input = \"…\" in [" + link.stage + "]" + (maker.empty() ? "" : ", or a section [" + maker + "]"));
  }

  void add_solve(const Settings& section) {
    const fs::path input = named_path(section, "input", base_);
    const std::string name = section.text("name", input.stem().string());
    const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
    if (!plain) throw Failure(ExitCode::misuse, "not a name for a folder: \"" + name + "\"", section.where("name"), "letters, digits, _ and -");
    const auto [earlier, fresh] = solve_where_.try_emplace(name, section.where());
    if (!fresh) throw Failure(ExitCode::misuse, "two solves are named \"" + name + "\"", section.where() + " and " + earlier->second, "another name = \"…\"");
    std::vector<std::string> words;
    if (section.has("mesh")) words = {"--mesh=" + named_path(section, "mesh", base_).string()};
    else if (made_.contains("mesh.vtu")) words = {"--mesh=" + (places_.result / "mesh.vtu").string()};
    add("solve", "solve " + name, section, input, {fs::path("solve") / name}, {"input", "name", "mesh"}, words);
  }

  void add_report(const Settings& section) { add("report", "report", section, places_.result, {"report.html"}, {}, {}); }

  void add(const std::string& stage, const std::string& name, const Settings& section, const fs::path& input, const std::vector<fs::path>& outputs,
           const std::vector<std::string>& reserved, const std::vector<std::string>& more_words) {
    const Json described = describe_(stage);
    StageCall call{stage, name, section.where(), input, outputs, {}, {input.string()}};
    for (const fs::path& output : outputs) {
      call.arguments.push_back((places_.result / output).string());
      made_.insert(output.generic_string());
    }
    for (const Json& output : described.at("outputs"))
      if (output.contains("suffix")) call.side_outputs.push_back(side_name(outputs.front(), output.at("suffix")));
    call.arguments.insert(call.arguments.end(), more_words.begin(), more_words.end());
    for (auto& word : option_words(section, reserved, described, base_)) call.arguments.push_back(std::move(word));
    plan_.calls.push_back(std::move(call));
  }

  const StudyPlaces& places_;
  const DescribeFunction& describe_;
  Settings root_;
  fs::path base_;
  StudyPlan plan_;
  std::set<std::string> made_;  ///< outputs of the stages so far
  std::map<std::string, std::string> solve_where_;
};

}  // namespace

StudyPlan read_study_plan(const StudyPlaces& places, const DescribeFunction& describe) { return Planner(places, describe).plan(); }

}  // namespace palpate
