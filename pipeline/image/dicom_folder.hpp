// The image series in a folder, and the choice of one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <pipeline/image/dicom_header.hpp>

namespace palpate {

struct DicomSeries {
  SeriesName name;
  std::vector<DicomFrame> frames;  ///< in order of file names
};

struct DicomFolder {
  std::vector<DicomSeries> series;             ///< ordered by number, then UID
  int foreign_files = 0;                       ///< not DICOM
  std::map<std::string, int> objects_without_image;  ///< by modality
};

/// Reads the headers of all files below the folder. Throws Failure(unreadable): no file, no DICOM file, no image, a damaged file.
DicomFolder scan_dicom_folder(const std::filesystem::path& folder);

/// The series whose UID, number or description is `wanted` (or whose description alone contains it, in any case); with an empty
/// `wanted` the only one. Throws Failure(misuse) with a list of the series when that is not exactly one.
const DicomSeries& choose_series(const DicomFolder& folder, const std::string& wanted);

}  // namespace palpate
