// One mask divided among its parts by their intensities: which voxels are uterus, which tube, which ovary.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include <pipeline/image/mask.hpp>

namespace palpate {

/// Each voxel of the mask gets the number (from 1) of one seed's part. Away from the mask's rim, where intensities mix with those outside, a voxel
/// belongs to the part whose seed has the nearest mean intensity within `neighbourhood_mm`; of these, what hangs together with its seed is the part's
/// core. All other voxels go to the core that reaches them in the fewest steps through the mask (six neighbours; ties to the smaller number).
/// Voxels no core reaches stay 0.
/// Throws Failure(misuse) for a seed outside the mask or too near its rim, Failure(refused) for two parts of the same mean intensity.
Labels divided(const Scan& scan, const Mask& mask, const std::vector<VoxelIndex>& seeds, double neighbourhood_mm);

}  // namespace palpate
