// Progress on stderr: a bar on a terminal, a plain line at most every few seconds elsewhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <string>

namespace palpate {

class Progress {
 public:
  Progress(std::string label, std::size_t total, bool silent);
  /// `done` of `total`; `remark` is shown behind it ("depth 2.1 mm").
  void update(std::size_t done, const std::string& remark = "");
  /// Ends the line. Called by the destructor too.
  void finish();
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;

 private:
  std::string label_;
  std::size_t total_;
  bool silent_, terminal_, open_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace palpate
