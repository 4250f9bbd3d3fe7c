// The case of a run with one of its numbers moved: what a shadow of the run follows (sensitivities.hpp).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <solver/case.hpp>

namespace palpate {

struct MovedCase {
  double change = 0;  ///< of the number
  Case the_case;
  bool at_end = false;     ///< of the number's range: its derivative is of one side
  bool is_secant = false;  ///< a finite change stands in for a derivative that does not exist, and needs a run of its own
};

/// The case with the number at `path` ("effect[0].g[1]") moved a little up, or down where that is refused: at the end of its range. Friction that is off in `still` has no
/// derivative: there it is moved to a coefficient of 0.05. Throws Failure(misuse) for a number that the case has not or that cannot be moved.
MovedCase moved_case(const Settings& settings, const std::filesystem::path& mesh, const std::string& path, const Case& still);

/// "a, b, c" as paths.
std::vector<std::string> number_paths(const std::string& list);

}  // namespace palpate
