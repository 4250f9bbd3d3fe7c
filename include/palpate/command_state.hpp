// What the command header keeps between parsing and commit. For command.cpp, command_card.cpp and run_program.cpp alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <palpate/arguments.hpp>
#include <palpate/command.hpp>
#include <palpate/outputs.hpp>

namespace palpate {

struct Command::State {
  Usage usage;
  std::vector<std::string> words;  ///< the command line
  Arguments arguments;
  std::map<std::string, std::filesystem::path> targets;  ///< outputs and side outputs by name
  std::map<std::string, PendingOutput> outputs;
  Json inputs = Json::array();  ///< for the card: what was read, with its hash
  std::vector<std::string> warnings;
  std::vector<Check> checks;
  Json notes = Json::object();
};

}  // namespace palpate
