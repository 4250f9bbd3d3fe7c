// One run of palpate-solve: force over depth of a tool at a place.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include <loop/set/set.hpp>

namespace palpate::loop {

/// Force over depth as a solve gave it: depths and forces above zero.
struct SolvedCurve {
  std::vector<double> depth_mm, force_N;
  /// N; relative to the power 3/2 of depth between the points and beyond them.
  double at(double depth) const;
};

/// A tool at a place, how deep, and where solves are kept.
struct SiteJob {
  const Set* set;
  const Run* run;
  double deepest_mm;
  std::filesystem::path solver, kept;
};

struct SolvedMotion {
  std::vector<double> t_s, depth_mm, force_N;
};

/// Solves case text (without tool and steps) on a mesh along `motion` (the tool's way and [steps]), unless the folder `kept` has this very solve by this very program. One thread.
/// Throws Failure(not_converged) naming the tool when it fails.
SolvedMotion solved_motion(const SiteJob& job, const std::string& text, const std::string& motion, const std::filesystem::path& mesh);

/// The same straight down to the deepest point; it throws, too, when 60 % of the depth are not reached.
SolvedCurve solved(const SiteJob& job, const std::string& text, const std::filesystem::path& mesh, int steps = 14);

}  // namespace palpate::loop
