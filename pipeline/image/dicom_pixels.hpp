// Stored values of a DICOM file, decoded from any transfer syntax GDCM knows.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

namespace palpate {

struct StoredPixels {
  int columns = 0, rows = 0, frames = 0;
  std::vector<double> values;  ///< frame after frame, row after row; not rescaled
};

/// Throws Failure(unreadable) naming the file: truncated, undecodable, colour, or no pixel data.
StoredPixels read_stored_pixels(const std::filesystem::path& path);

}  // namespace palpate
