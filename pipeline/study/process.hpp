// A program run to its end; it dies with its parent.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace palpate {

struct ProcessResult {
  int code = 0;        ///< exit code; -1 when a signal ended it
  int signal = 0;      ///< that signal, or 0
  std::string output;  ///< what it wrote to stdout
};

/// Runs `program` with stderr shared and stdout captured. When this process ends, however it ends, the child gets SIGTERM.
/// Throws Failure(unreadable) when there is no such program.
ProcessResult run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments);

/// Becomes `program`; returns only by throwing Failure(unreadable).
[[noreturn]] void become_process(const std::filesystem::path& program, const std::vector<std::string>& arguments);

/// The folder of the running executable (/proc/self/exe).
std::filesystem::path own_folder();

}  // namespace palpate
