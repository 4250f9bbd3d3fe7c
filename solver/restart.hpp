// The file in an unfinished result folder from which the next run of the same command continues a run that was killed.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <palpate/command.hpp>

namespace palpate {

class Restart {
 public:
  /// `c`: of a program that continues (Usage::continues), all of its inputs added.
  Restart(Command& c, std::filesystem::path folder);

  /// What write() was given last by a killed run with the same program, inputs, options and threads. Otherwise nothing, the folder is
  /// empty, and the person is told why: nothing there, something else's, damaged.
  std::optional<std::string> read();
  /// Replaces the file, whole: killed meanwhile, the former stays. Not every time: where `files` has a new one (a frame, a mesh), and otherwise so
  /// that writing takes at most a twentieth of the run. `files` of the folder, written before, must stay as they are for the file to count. On a
  /// full disk the run goes on without.
  void write(const std::function<std::string()>& bytes, const std::vector<std::string>& files);
  /// Before the folder is delivered.
  void remove();

 private:
  Command& command_;
  std::filesystem::path folder_, path_;
  std::string identity_;
  std::map<std::string, std::string> hashes_;  ///< of files that were written
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::time_point::min();
  bool possible_ = true;
};

}  // namespace palpate
