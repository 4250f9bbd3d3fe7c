// A study folder as the report sees it: which stages ran, their cards, and the files worth showing.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <palpate/json.hpp>
#include <pipeline/report/history.hpp>

namespace palpate {

struct Stage {
  std::string name;  ///< "mesh"; of a solve "solve neo_hookean"
  std::filesystem::path output;
  Json card;  ///< null when there is none
};

struct Frame {
  std::filesystem::path file;
  double time_s = 0;
};

struct Solve {
  std::string name;
  std::filesystem::path folder;
  History history;
  Json summary;
  std::vector<Frame> frames;  ///< in time; may be empty
};

struct Study {
  std::string title;
  std::vector<Stage> stages;            ///< in the order of the chain
  std::string sheet_png;                ///< the bytes of labels.sheet.png; empty when absent
  std::filesystem::path surface, mesh;  ///< empty when absent
  std::vector<Solve> solves;
  std::vector<std::filesystem::path> files_read;  ///< every file that was opened, or will be shown, in a fixed order
};

/// Reads study.json when it is there and finds the stages' usual names in any case. Throws Failure(unreadable) when the folder
/// holds nothing that is known, or a file of it is damaged.
Study read_study(const std::filesystem::path& folder);

/// A folder of palpate-solve; adds the files that were opened, or will be shown. Throws Failure(unreadable) naming file and line.
Solve read_solve(const std::filesystem::path& folder, std::vector<std::filesystem::path>& files_read);

/// The card of the stage whose tool is `tool` ("palpate-mesh"); null when there is none.
const Json& card_of(const Study& study, const std::string& tool);

/// The frame at the greatest depth of a solve; nothing when it has no frames.
const Frame* deepest_frame(const Solve& solve);

}  // namespace palpate
