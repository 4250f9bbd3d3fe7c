// The phantom a TOML file asks for: one organ, where it lies, and how it is scanned.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include <palpate/volume.hpp>
#include <pipeline/image/phantom_organs.hpp>

namespace palpate {

/// How the scanner sees the organ.
struct ScanSettings {
  Vec3 row_direction{1, 0, 0};     ///< unit vector along which the column index grows
  Vec3 column_direction{0, 1, 0};  ///< unit vector along which the row index grows
  Vec3 voxel_mm{1, 1, 1};          ///< along rows, along columns, between slices
  double slice_thickness_mm = 1;   ///< of the header, and of the slab a voxel averages over
  double margin_mm = 15;           ///< around the organ's bounding box
  double background = 250;         ///< intensity of the fat around the organ
  double noise = 0.05;             ///< σ of each channel over the intensity of the organ's last part (cortex, wall)
  double bias = 0.1;               ///< largest relative change by the coil
  int supersampling = 5;           ///< samples per voxel edge where a voxel is cut by a boundary
};

struct PhantomSpec {
  std::string title;
  Organ organ;  ///< in the patient, LPS mm
  ScanSettings scan;
};

/// Throws Failure(misuse) with file and line for a key that is missing, misspelt or out of range, or for numbers that make no organ.
PhantomSpec read_phantom_spec(const std::filesystem::path& path);

/// The scan's lattice: the organ's box with a margin, centred, axes row × column × slice. Throws Failure(misuse) when it gets too large.
Grid scan_grid(const PhantomSpec& spec);

}  // namespace palpate
