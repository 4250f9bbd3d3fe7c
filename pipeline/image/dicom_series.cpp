// Reading slices: each file is decoded once, whatever number of frames it holds.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_series.hpp>

#include <map>

#include <palpate/errors.hpp>
#include <pipeline/image/dicom_pixels.hpp>

namespace palpate {

Scan read_slices(const SliceStack& stack, Progress& progress) {
  Scan scan{stack.grid, std::vector<float>(stack.grid.count())};
  std::map<std::filesystem::path, std::vector<int>> slices_of;
  for (int k = 0; k < stack.grid.size[2]; ++k) slices_of[stack.frames[k].file].push_back(k);
  const std::size_t count = std::size_t(stack.grid.size[0]) * stack.grid.size[1];
  std::size_t done = 0;
  for (const auto& [file, slices] : slices_of) {
    const StoredPixels pixels = read_stored_pixels(file);
    for (int k : slices) {
      const DicomFrame& frame = stack.frames[k];
      if (pixels.columns != frame.columns || pixels.rows != frame.rows || pixels.frames != frame.frames)
        throw Failure(ExitCode::unreadable, "the image has another size than its header says", frame.name(), "copy the file again from its source");
      for (std::size_t p = 0; p < count; ++p)
        scan.voxels[k * count + p] = static_cast<float>(frame.slope * pixels.values[frame.index * count + p] + frame.intercept);
      progress.update(++done);
    }
  }
  return scan;
}

}  // namespace palpate
