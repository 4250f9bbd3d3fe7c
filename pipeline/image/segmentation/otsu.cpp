// Otsu: the bright or the dark side of the threshold t = argmax ω₀ ω₁ (μ₁ − μ₀)² (Otsu 1979, eq. 14), found within the box.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/segmentation.hpp>

#include <limits>
#include <sstream>

#include <palpate/errors.hpp>
#include <pipeline/image/histogram.hpp>

namespace palpate::segmentation {
namespace {

constexpr int bins = 2048;  // threshold exact to 1/2048 of the range

Choice choose(const Task& task) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (task.lower || task.upper)
    throw Failure(ExitCode::misuse, "thresholds are given, and otsu is asked to find one", "",
                  "--method threshold, or no thresholds");
  const Histogram histogram = histogram_of(intensities_of(task.scan, task.domain), bins);
  const auto t = otsu_threshold(histogram);
  if (!t) {
    std::ostringstream what;
    what << "no threshold can be found: all voxels have the intensity " << histogram.min;
    throw Failure(ExitCode::refused, what.str(), "", "another scan, or a box that holds the organ and its surroundings");
  }
  const double lower = task.keep == "bright" ? *t : -infinity;
  const double upper = task.keep == "bright" ? infinity : *t;
  return {within(task, lower, upper), lower, upper};
}

}  // namespace

Method otsu() {
  return {{"segmentation",
           "otsu",
           "The bright (or dark) side of the threshold that separates the intensities best into two classes.",
           "N. Otsu, A threshold selection method from gray-level histograms, IEEE Trans. SMC 9 (1979), eq. 14",
           {}},
          choose};
}

}  // namespace palpate::segmentation
