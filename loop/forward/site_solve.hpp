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

/// Solves case text (without tool and steps) on a mesh, unless the folder `kept` has this very solve by this very program. One thread. Throws Failure(not_converged) naming
/// the tool when it fails or does not reach 60 % of its depth.
SolvedCurve solved(const SiteJob& job, const std::string& text, const std::filesystem::path& mesh);

}  // namespace palpate::loop
