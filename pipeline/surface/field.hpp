// A smooth field from a mask, whose zero set is the organ's surface between the voxels: no staircases at any spacing.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include <pipeline/surface/mask.hpp>

namespace palpate {

/// The smoothing at which voxels no longer show, in mm: 1.5 of the coarsest spacing, along every axis alike. A face tilted
/// against the slices is a row of terraces in the labels; blurring across the slices alone leaves them, blurring along them too
/// averages them out.
double default_smooth_mm(const Grid& grid);

/// Standard deviation of the Gaussian per voxel axis, in mm: `smooth_mm`, but at least half of the spacing along that axis, below
/// which the space between voxels is not bridged.
std::array<double, 3> gaussian_mm(const Grid& grid, double smooth_mm);

/// Weights c per voxel such that G_σ * c, cut at the level that holds as many voxels as the mask, agrees with the mask wherever
/// blurring the mask itself would lose thin or small parts: c ← c + 2 v, v the amount by which a voxel lies on the wrong side by
/// more than `slack_mm` (projection onto the constraints by gradient steps; 0 steps: the mask itself).
Scan consistent_weights(const Mask& mask, const std::array<double, 3>& sigma_mm, double slack_mm, int steps);

/// f = Φ⁻¹(G_σ * c) on a cubic lattice of `step_mm` along the voxel axes: positive inside, near the surface proportional to the
/// distance, and zero where the blurred weights are one half. The border is outside everywhere.
Scan organ_field(const Scan& weights, const std::array<double, 3>& sigma_mm, double step_mm);

/// Quantile of the standard normal distribution, 0 < p < 1, to 4.5e-4 absolute (Abramowitz & Stegun 1964, 26.2.23).
double normal_quantile(double p);

}  // namespace palpate
