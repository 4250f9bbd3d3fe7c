// Failure: what went wrong, where, what to try next, and the exit code that says it to a script.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <stdexcept>
#include <string>

namespace palpate {

/// Exit codes of every executable (docs/formats.md). `unreadable` covers a file that cannot be read or written.
enum class ExitCode {
  done = 0,
  defect = 1,
  misuse = 2,
  unreadable = 3,
  check_failed = 4,
  not_converged = 5,
  refused = 6,
};

/// Something the user can act on. Thrown anywhere, printed and turned into an exit code by the command header.
class Failure : public std::runtime_error {
 public:
  /// `what`: the problem; `where`: file, slice, triangle with mm coordinates; `next`: what to try. The last two may be empty.
  Failure(ExitCode code, std::string what, std::string where = "", std::string next = "")
      : std::runtime_error(text(what, where, next)), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  static std::string text(const std::string& what, const std::string& where, const std::string& next) {
    return what + (where.empty() ? "" : "\n  where: " + where) + (next.empty() ? "" : "\n  try:   " + next);
  }
  ExitCode code_;
};

}  // namespace palpate
