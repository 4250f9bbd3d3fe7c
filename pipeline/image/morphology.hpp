// Opening A∘B and closing A•B with a ball B of a radius in mm (an ellipsoid of voxels where spacing is anisotropic).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <pipeline/image/mask.hpp>

namespace palpate {

/// All voxels whose centre is within `radius_mm` of a centre inside, clipped to the scan.
Mask dilated(const Mask& mask, double radius_mm);

/// All voxels inside whose ball of `radius_mm` lies inside; beyond the scan counts as outside.
Mask eroded(const Mask& mask, double radius_mm);

/// Erosion, then dilation: removes bridges and spikes thinner than the ball, never adds a voxel.
Mask opened(const Mask& mask, double radius_mm);

/// Dilation, then erosion, on a lattice large enough for the ball: fills gaps narrower than the ball, never removes a voxel.
Mask closed(const Mask& mask, double radius_mm);

}  // namespace palpate
