// Methods that say which voxels are the organ; every file of segmentation/ is one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <palpate/catalogue.hpp>
#include <pipeline/image/mask.hpp>

namespace palpate::segmentation {

/// What a method may look at.
struct Task {
  const Scan& scan;                    ///< smoothed
  const Mask& domain;                  ///< voxels that may be chosen (a box); same grid
  std::optional<double> lower, upper;  ///< interval of intensities, ends included
  std::vector<VoxelIndex> seeds;
  std::string keep = "bright";  ///< which side of an automatic threshold: bright or dark
  double neighbourhood_mm = 0;  ///< of a seed, for its statistics
  double interval_sd = 0;       ///< half width of an automatic interval, in standard deviations
};

/// What it chose, and the interval of intensities it used; infinite ends are open.
struct Choice {
  Mask mask;
  double lower, upper;
};

struct Method {
  CatalogueEntry about;
  /// Throws Failure(misuse) for missing or contradictory options, Failure(refused) when the scan cannot tell.
  Choice (*choose)(const Task& task);
};

/// Every method of the folder, in alphabetical order.
std::vector<Method> all();

/// The method of that name. Requires that there is one.
Method by_name(const std::string& name);

/// The voxels of the domain with an intensity in [lower, upper].
Mask within(const Task& task, double lower, double upper);

/// The intensities of the domain's voxels.
std::vector<float> intensities_of(const Scan& scan, const Mask& domain);

}  // namespace palpate::segmentation
