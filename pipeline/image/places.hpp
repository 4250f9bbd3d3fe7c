// Places a person names in mm, found in the voxels of a scan.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <pipeline/image/mask.hpp>

namespace palpate {

/// "x -12.0 … 31.5, y …, z … mm": the box of patient space that the scan's voxels fill.
std::string extent_text(const Grid& grid);

/// The voxels that hold the points (patient LPS, mm). Throws Failure(misuse), naming point and extent, when one is outside.
std::vector<VoxelIndex> voxels_at(const Grid& grid, const std::vector<Vec3>& points);

/// Voxels with their centre in the box of two opposite corners (patient LPS, mm); all voxels when there are no corners.
/// Throws Failure(misuse) for another number of corners or a box without voxels.
Mask box_mask(const Grid& grid, const std::vector<Vec3>& corners);

/// Corners (lowest, highest coordinates) of the patient box around the voxels of a block, voxel edges included.
std::array<Vec3, 2> box_mm(const Grid& grid, const Block& block);

}  // namespace palpate
