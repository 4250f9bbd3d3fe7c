// study.toml as calls of stages: sections present are stages run, in the order of the chain.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <palpate/json.hpp>

namespace palpate {

/// One stage to be run.
struct StageCall {
  std::string stage;                            ///< "solve" for palpate-solve
  std::string name;                             ///< "solve neo_hookean"; otherwise the stage
  std::string where;                            ///< "study.toml:12", of its section
  std::filesystem::path input;                  ///< the first thing it reads
  std::vector<std::filesystem::path> outputs;   ///< relative to the result folder
  std::vector<std::string> side_outputs;        ///< as above, names that follow from an output's
  std::vector<std::string> arguments;           ///< input, outputs, --name=value…
};

struct StudyPlan {
  std::string title;
  std::vector<StageCall> calls;
};

struct StudyPlaces {
  std::filesystem::path study;                 ///< study.toml; its relative paths start at its folder
  std::filesystem::path result;                ///< where everything is written
  std::optional<std::filesystem::path> dicom;  ///< read by [import] instead of what the study says; drops [phantom]
};

/// A stage's answer to --describe.
using DescribeFunction = std::function<Json(const std::string& stage)>;

/// Reads and checks all of a study before anything runs. Throws Failure(misuse) with file and line: an unknown section, key or option
/// with the nearest known one, a value of the wrong kind, a stage whose predecessor is missing, two solves of one name; Failure(unreadable)
/// for an input that is not there.
StudyPlan read_study_plan(const StudyPlaces& places, const DescribeFunction& describe);

}  // namespace palpate
