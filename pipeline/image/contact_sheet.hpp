// A contact sheet: slices through a label with its contour, so that a person sees at a glance whether it is right.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <pipeline/image/mask.hpp>

namespace palpate {

/// What the sheet says about the label.
struct SheetText {
  std::string name;
  std::vector<std::string> facts;  ///< short lines; "mm^3" raises the 3
};

/// The sheet as the bytes of a PNG: three views of the whole scan, then about 24 slices around the label, from its first to its
/// last along the coarsest axis, in true proportions, with position, patient directions and a scale bar. Requires a label that is
/// not empty.
std::string contact_sheet_png(const Scan& scan, const Mask& mask, const SheetText& text);

}  // namespace palpate
