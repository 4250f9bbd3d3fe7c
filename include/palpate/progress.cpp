// Progress on stderr.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/progress.hpp>

#include <unistd.h>

#include <iostream>

namespace palpate {

using namespace std::chrono_literals;

Progress::Progress(std::string label, std::size_t total, bool silent)
    : label_(std::move(label)), total_(total), silent_(silent), terminal_(isatty(STDERR_FILENO)) {
  last_ = std::chrono::steady_clock::now();
}

void Progress::update(std::size_t done, const std::string& remark) {
  if (silent_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < (terminal_ ? 100ms : 5000ms) && done < total_) return;
  if (!terminal_ && done >= total_ && !open_) return;  // short work needs no line
  last_ = now;
  const std::size_t percent = total_ ? 100 * done / total_ : 100;
  if (terminal_) {
    const std::string bar(percent / 4, '#');
    std::cerr << "\r\033[K" << label_ << " [" << bar << std::string(25 - bar.size(), ' ') << "] " << percent << " % " << remark
              << std::flush;
  } else {
    std::cerr << label_ << ": " << percent << " % " << remark << "\n";
  }
  open_ = true;
}

void Progress::finish() {
  if (open_ && terminal_) std::cerr << "\n";
  open_ = false;
}

}  // namespace palpate
