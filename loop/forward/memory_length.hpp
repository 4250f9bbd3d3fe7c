// How large strain changes what a row of springs remembers, from one solved motion.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/forward/site_solve.hpp>

namespace palpate::loop {

/// The tissue of that motion relaxes (an [[effect]] of a case): ramp, hold, and back, at the pace of the relaxation.
std::string relaxing_words();
std::string relaxing_motion(double deepest_mm);

struct MemoryLength {
  double mm = 0;             ///< of Row; 0: springs as they are do as well
  double before = 0, after = 0;  ///< rms that the row misses of the motion, over the largest force: springs as they are, and with the length
};

/// The length with which a row cut from the elastic curve `own`, of the same mesh, follows the solved motion best (golden section in its logarithm).
MemoryLength memory_length(const SolvedMotion& relaxed, const SolvedCurve& own, double deepest_mm);

}  // namespace palpate::loop
