// gmsh between initialize and finalize: silent, on one thread, the same on every run.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

namespace palpate {

class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;

  /// Log lines of a level: "Error", "Warning".
  std::vector<std::string> lines(const std::string& level) const;
};

}  // namespace palpate
