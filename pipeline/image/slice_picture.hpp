// One slice as a picture: windowed, in true proportions, with the contour of a mask.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <pipeline/image/ink.hpp>
#include <pipeline/image/mask.hpp>
#include <pipeline/image/slice_view.hpp>

namespace palpate {

/// Intensities shown as black and white.
struct Window {
  float black = 0, white = 1;
};

/// Voxels of a slice that are shown, counted as shown (after flips); both ends included.
struct Crop2 {
  int first_across = 0, last_across = 0, first_down = 0, last_down = 0;
  int across() const { return last_across - first_across + 1; }
  int down() const { return last_down - first_down + 1; }
};

/// The part of the view that shows `block`.
Crop2 crop_of(const Block& block, const Grid& grid, const SliceView& view);

/// Slice `n` along view.through as a picture of width x height pixels (BGR), with the mask's half-level contour drawn in
/// `colour`.
cv::Mat slice_picture(const Scan& scan, const Mask& mask, const SliceView& view, int n, const Crop2& crop, int width, int height,
                      const Window& window, const ink::Colour& colour);

}  // namespace palpate
