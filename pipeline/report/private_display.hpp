// A private X server without a screen (Xvfb), so that VTK can draw on a machine that has none, and draws alike on all.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <sys/types.h>

namespace palpate {

/// Starts Xvfb on a display number of its own, points DISPLAY at it and Mesa at its software renderer. The server ends with
/// this object or with this process, also after kill -9. Without Xvfb the DISPLAY at hand is used.
class PrivateDisplay {
 public:
  /// Throws Failure(unreadable) when there is neither Xvfb nor a DISPLAY.
  PrivateDisplay();
  ~PrivateDisplay();
  PrivateDisplay(const PrivateDisplay&) = delete;

 private:
  pid_t server_ = -1;
};

}  // namespace palpate
