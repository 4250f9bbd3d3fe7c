// Frames of a series as one regular lattice, ordered by position along the normal; whatever is not regular is refused with its place.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <palpate/volume.hpp>
#include <pipeline/image/dicom_header.hpp>

namespace palpate {

struct SliceStack {
  std::vector<DicomFrame> frames;  ///< slice k of the grid is frame k
  Grid grid;                       ///< i along rows, j along columns, k along row × column
  double pitch_mm = 0;             ///< between slices, along their normal
  double tilt_deg = 0;             ///< between the slices' normal and the line of their first pixels (gantry tilt)
  std::vector<std::string> warnings;
};

/// Throws Failure(check_failed): a frame without position, mixed sizes, spacings or orientations, two frames at one position,
/// a missing slice, an uneven pitch. Localizers among other images are left out with a warning.
SliceStack stack_slices(std::vector<DicomFrame> frames);

/// "axial", "coronal", "sagittal", with "oblique" before it when the normal is more than 1° off: for people.
std::string orientation_name(const Grid& grid);

}  // namespace palpate
