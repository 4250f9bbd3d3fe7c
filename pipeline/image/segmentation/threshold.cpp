// Threshold: all voxels with lower ≤ I ≤ upper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/segmentation.hpp>

#include <limits>

#include <palpate/errors.hpp>

namespace palpate::segmentation {
namespace {

Choice choose(const Task& task) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!task.lower && !task.upper)
    throw Failure(ExitCode::misuse, "a threshold without a number", "",
                  "--threshold-lower, --threshold-upper, or --method otsu to find one");
  const double lower = task.lower.value_or(-infinity), upper = task.upper.value_or(infinity);
  return {within(task, lower, upper), lower, upper};
}

}  // namespace

Method threshold() {
  return {{"segmentation",
           "threshold",
           "All voxels with an intensity in an interval.",
           "",
           {{"threshold-lower", "1", {}, 0, "lowest intensity"}, {"threshold-upper", "1", {}, 0, "highest intensity"}}},
          choose};
}

}  // namespace palpate::segmentation
