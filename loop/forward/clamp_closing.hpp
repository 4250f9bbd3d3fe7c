// One closing of a clamp, by palpate-idealize, palpate-mesh and palpate-solve; kept by its content.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <loop/forward/model.hpp>

namespace palpate::loop {

inline constexpr double ahead_mm = 1.5;  ///< jaws start so much farther apart than the declared diameter: a thicker wall is touched earlier

/// What one solve is of.
struct Closing {
  double edge_mm = 3, friction = 0, angle_deg = 0;
  bool fine_folds = false;              ///< of the curve itself; what changes it is solved with coarser ones, with and without
  double from = 0, to = 0, excess = 0;  ///< of a slice, along the tube from its end
  int parameter = -1;                   ///< of the law, times 1.5
  bool works = false;                   ///< stress_works.csv as well
  double speed_mm_s = 200;              ///< slower where the wall swings too much
};

/// Where and with what.
struct Bench {
  const Set& set;
  Model start;  ///< with the modulus of the solves
  std::filesystem::path kept, mesh_program, tube_program, solver;
  std::string version;  ///< hash of the solver
  double deepest_mm;
  double stop_gap_mm() const { return set.specimen.size_mm[0] - deepest_mm; }
};

/// The folder of the solve's result, run or kept. Throws Failure(not_converged) with the program's words.
std::filesystem::path closed(const Bench& bench, const Run& run, Closing closing);

}  // namespace palpate::loop
