// Filters that calm a scan before it is segmented; every file of smoothing/ is one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include <palpate/catalogue.hpp>
#include <palpate/volume.hpp>

namespace palpate::smoothing {

/// How much to smooth.
struct Amount {
  double width_mm = 0;                    ///< the filter's reach: a standard deviation or a radius, as its entry says
  std::optional<double> intensity_width;  ///< of filters that keep edges: differences much above it are edges
};

struct Filter {
  CatalogueEntry about;
  /// Same grid. Spacing may differ by axis; axes are taken as orthogonal.
  Scan (*apply)(const Scan& scan, const Amount& amount);
};

/// Every filter of the folder, in alphabetical order.
std::vector<Filter> all();

/// The filter of that name. Requires that there is one.
Filter by_name(const std::string& name);

/// Standard deviation of white noise, from the Laplacian of each slice, which structure hardly enters:
/// σ = √(π/2) · mean |L * I| / 6 with L = (1 −2 1; −2 4 −2; 1 −2 1).
/// J. Immerkær, Fast noise variance estimation, CVIU 64 (1996), eq. 4.
double noise_sd(const Scan& scan);

/// Reach of the default: 0.7 of the edge of a cube as large as a voxel.
double default_width_mm(const Grid& grid);

}  // namespace palpate::smoothing
