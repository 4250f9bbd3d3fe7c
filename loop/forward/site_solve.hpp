// One run of palpate-solve, kept under the hash of all that went into it: force over time, or over depth of a tool at a place.
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

/// Solves a case on a mesh, unless the folder `kept` has this very solve by this very program. One thread. Throws Failure(not_converged) with the solver's words when it fails.
SolvedMotion solved_case(const std::string& case_text, const std::filesystem::path& mesh, const std::filesystem::path& solver, const std::filesystem::path& kept);

/// The part of it where the tool is in the tissue and presses.
SolvedCurve curve_of(const SolvedMotion& motion);

/// Solves case text (without tool and steps) on a mesh along `motion` (the tool's way and [steps]). Throws Failure(not_converged) naming the tool when it fails.
SolvedMotion solved_motion(const SiteJob& job, const std::string& text, const std::string& motion, const std::filesystem::path& mesh);

/// The same straight down to the deepest point; it throws, too, when 60 % of the depth are not reached.
SolvedCurve solved(const SiteJob& job, const std::string& text, const std::filesystem::path& mesh, int steps = 14);

}  // namespace palpate::loop
