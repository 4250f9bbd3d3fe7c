// Known names first, study.json for title and order.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/study.hpp>

#include <algorithm>
#include <cmath>
#include <regex>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <palpate/text_file.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void damaged(const fs::path& path, const std::string& what) {
  throw Failure(ExitCode::unreadable, what, path.string(), "run the stage that writes it again");
}

/// A JSON file that must be an object.
Json read_object(const fs::path& path) {
  Json json = read_json(path);
  if (!json.is_object()) damaged(path, "not a JSON object");
  return json;
}

/// What the page reads of every card has its type.
void expect_card(const Json& card, const fs::path& path) {
  try {
    card.value("tool", "");
    card.value("version", "");
    card.value("seconds", 0.0);
    for (const Json& check : card.value("checks", Json::array())) {
      check.value("name", "");
      check.value("limit", "");
      check.value("pass", false);
    }
  } catch (const Json::exception& error) {
    damaged(path, std::string("not a card: ") + error.what());
  }
}

Stage read_stage(Study& study, const std::string& name, const fs::path& output) {
  Stage stage{name, output, nullptr};
  const fs::path card = card_path(output);
  if (fs::is_regular_file(card)) {
    stage.card = read_object(card);
    expect_card(stage.card, card);
    study.files_read.push_back(card);
  }
  return stage;
}

/// Stages by the usual names of their outputs, in the order of the chain.
std::vector<std::pair<std::string, fs::path>> usual_stages(const fs::path& folder) {
  std::vector<std::pair<std::string, fs::path>> stages{{"phantom", folder / "dicom"},
                                                       {"import", folder / "scan.nii.gz"},
                                                       {"segment", folder / "labels.nii.gz"},
                                                       {"surface", folder / "surface.vtp"},
                                                       {"mesh", folder / "mesh.vtu"}};
  std::vector<fs::path> solves;
  if (fs::is_directory(folder / "solve"))
    for (const auto& entry : fs::directory_iterator(folder / "solve"))
      if (entry.is_directory() && fs::exists(entry.path() / "history.csv")) solves.push_back(entry.path());
  std::sort(solves.begin(), solves.end());
  for (const auto& solve : solves) stages.emplace_back("solve " + solve.filename().string(), solve);
  return stages;
}

/// study.json: {title, stages: [{name, output}]}; the report itself is no part of what it shows.
std::vector<std::pair<std::string, fs::path>> listed_stages(Study& study, const fs::path& folder) {
  const fs::path path = folder / "study.json";
  if (!fs::is_regular_file(path)) return {};
  const Json json = read_object(path);
  study.files_read.push_back(path);
  std::vector<std::pair<std::string, fs::path>> stages;
  try {
    study.title = json.value("title", "");
    for (const Json& stage : json.value("stages", Json::array())) {
      const std::string output = stage.value("output", "");
      if (!output.empty() && stage.at("name") != "report")
        stages.emplace_back(stage.at("name").get<std::string>(), folder / output);
    }
  } catch (const Json::exception& error) {
    damaged(path, std::string("not a study: ") + error.what());
  }
  return stages;
}

/// The entries of a ParaView collection, `<DataSet timestep="0.1" … file="frames/frame_0001.vtu"/>`.
std::vector<Frame> read_frames(const fs::path& pvd) {
  const std::string text = read_text(pvd);
  static const std::regex entry("<DataSet[^>]*>"), time("timestep=\"([^\"]*)\""), file("file=\"([^\"]*)\"");
  std::vector<Frame> frames;
  for (std::sregex_iterator match(text.begin(), text.end(), entry), end; match != end; ++match) {
    const std::string tag = match->str();
    std::smatch time_text, file_text;
    if (!std::regex_search(tag, time_text, time) || !std::regex_search(tag, file_text, file))
      damaged(pvd, "a frame without time or file");
    char* rest = nullptr;
    const std::string number = time_text[1];
    const double seconds = std::strtod(number.c_str(), &rest);
    if (number.empty() || *rest != 0 || !std::isfinite(seconds)) damaged(pvd, "a frame's time is not a number: " + number);
    frames.push_back({pvd.parent_path() / file_text[1].str(), seconds});
  }
  if (frames.empty() || text.find("</VTKFile>") == std::string::npos) damaged(pvd, "not a ParaView collection, or cut short");
  return frames;
}

fs::path known_file(Study& study, const fs::path& path) {
  if (!fs::is_regular_file(path)) return {};
  study.files_read.push_back(path);
  return path;
}

/// A PNG's bytes; its ends are looked at, so that a broken picture is not shown.
std::string read_sheet(Study& study, const fs::path& path) {
  if (known_file(study, path).empty()) return "";
  const std::string png = read_text(path);
  if (!png.starts_with("\x89PNG\r\n\x1a\n") || png.find("IEND", std::max<std::size_t>(png.size(), 12) - 12) == std::string::npos)
    damaged(path, "not a PNG picture, or cut short");
  return png;
}

bool is_solve(const fs::path& output) { return fs::is_regular_file(output / "history.csv"); }

}  // namespace

Solve read_solve(const fs::path& folder, std::vector<fs::path>& files_read) {
  Solve solve{folder.filename().string(), folder, read_history(folder / "history.csv"), Json::object(), {}};
  files_read.push_back(folder / "history.csv");
  if (fs::is_regular_file(folder / "summary.json")) {
    solve.summary = read_object(folder / "summary.json");
    files_read.push_back(folder / "summary.json");
  }
  if (fs::is_regular_file(folder / "frames.pvd")) {
    solve.frames = read_frames(folder / "frames.pvd");
    files_read.push_back(folder / "frames.pvd");
  }
  if (const Frame* frame = deepest_frame(solve)) files_read.push_back(frame->file);
  return solve;
}

Study read_study(const fs::path& folder) {
  Study study;
  auto stages = listed_stages(study, folder);
  for (const auto& usual : usual_stages(folder)) {
    const bool listed = std::any_of(stages.begin(), stages.end(), [&](const auto& stage) {
      return stage.second.lexically_normal() == usual.second.lexically_normal();
    });
    if (!listed && fs::exists(usual.second)) stages.push_back(usual);
  }
  for (const auto& [name, output] : stages) study.stages.push_back(read_stage(study, name, output));
  study.sheet_png = read_sheet(study, folder / "labels.sheet.png");
  study.surface = known_file(study, folder / "surface.vtp");
  study.mesh = known_file(study, folder / "mesh.vtu");
  for (const auto& stage : study.stages)
    if (is_solve(stage.output)) study.solves.push_back(read_solve(stage.output, study.files_read));
  if (study.sheet_png.empty() && study.surface.empty() && study.mesh.empty() && study.solves.empty())
    throw Failure(ExitCode::unreadable, "nothing to show: no labels.sheet.png, surface.vtp, mesh.vtu or solve/*/history.csv",
                  folder.string(), "give the folder that palpate run made");
  if (study.title.empty()) study.title = fs::absolute(folder).lexically_normal().filename().string();
  return study;
}

const Json& card_of(const Study& study, const std::string& tool) {
  static const Json none;
  for (const Stage& stage : study.stages)
    if (stage.card.is_object() && stage.card.value("tool", "") == tool) return stage.card;
  return none;
}

const Frame* deepest_frame(const Solve& solve) {
  const auto &times = solve.history.column("t[s]"), &depths = solve.history.column("depth[mm]");
  const Frame* best = nullptr;
  double best_depth = -std::numeric_limits<double>::infinity();
  for (const Frame& frame : solve.frames) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < times.size(); ++i)
      if (std::abs(times[i] - frame.time_s) < std::abs(times[nearest] - frame.time_s)) nearest = i;
    if (depths[nearest] >= best_depth) {
      best = &frame;
      best_depth = depths[nearest];
    }
  }
  return best;
}

}  // namespace palpate
