// Reading slices: each file is decoded once, whatever number of frames it holds.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_series.hpp>

#include <map>
#include <vector>

#include <palpate/errors.hpp>
#include <pipeline/image/dicom_pixels.hpp>
#include <pipeline/image/guarded.hpp>

namespace palpate {

namespace {

/// Decodes one file and rescales its frames into their slices.
void read_file(const std::filesystem::path& file, const std::vector<int>& slices, const SliceStack& stack, float* voxels) {
  const std::size_t count = std::size_t(stack.grid.size[0]) * stack.grid.size[1];
  const StoredPixels pixels = read_stored_pixels(file);
  for (int k : slices) {
    const DicomFrame& frame = stack.frames[k];
    if (pixels.columns != frame.columns || pixels.rows != frame.rows || pixels.frames != frame.frames)
      throw Failure(ExitCode::unreadable, "the image has another size than its header says", frame.name(), "copy the file again from its source");
    for (std::size_t p = 0; p < count; ++p)
      voxels[k * count + p] = static_cast<float>(frame.slope * pixels.values[frame.index * count + p] + frame.intercept);
  }
}

}  // namespace

Scan read_slices(const SliceStack& stack, Progress& progress) {
  std::map<std::filesystem::path, std::vector<int>> slices_of;
  for (int k = 0; k < stack.grid.size[2]; ++k) slices_of[stack.frames[k].file].push_back(k);
  const auto memory = shared_bytes(stack.grid.count() * sizeof(float));
  float* voxels = static_cast<float*>(memory.get());
  run_guarded([&](const NowReading& now_reading) {
    std::size_t done = 0;
    for (const auto& [file, slices] : slices_of) {
      now_reading(file.string());
      read_file(file, slices, stack, voxels);
      progress.update(done += slices.size());
    }
  });
  return {stack.grid, std::vector<float>(voxels, voxels + stack.grid.count())};
}

}  // namespace palpate
