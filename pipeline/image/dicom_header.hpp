// What the header of a DICOM file says about its images: which series, where each frame lies, how stored values become real ones.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/vec3.hpp>

namespace palpate {

/// Where a frame lies. `row` and `column` are unit vectors along which the column and the row index grow.
struct FramePlane {
  Vec3 position{0, 0, 0};  ///< centre of the first pixel, LPS mm
  Vec3 row{1, 0, 0}, column{0, 1, 0};
  double column_step_mm = 1, row_step_mm = 1;  ///< along `row` and along `column`
};

/// One image: a whole single-frame file, or a frame of a multi-frame one.
struct DicomFrame {
  std::filesystem::path file;
  int index = 0;       ///< of the frame in its file
  int frames = 1;      ///< in that file
  int columns = 0, rows = 0;
  double slope = 1, intercept = 0;
  double thickness_mm = 0, spacing_between_mm = 0;  ///< of the header; 0: not said. Used for a single slice only
  std::optional<FramePlane> plane;
  std::string missing;    ///< which geometry is missing or damaged, when there is no plane
  bool localizer = false; ///< ImageType says so

  std::string name() const;  ///< the file, and the frame when there are several
};

/// What the series of a file is called. Any of these may be empty.
struct SeriesName {
  std::string uid, number, description, modality, study_uid, body_part;
  auto operator<=>(const SeriesName&) const = default;
};

struct DicomHeader {
  SeriesName series;
  std::string sop_class;
  std::vector<DicomFrame> frames;  ///< empty: no image of a patient (a report, contours, a segmentation, a dose)
};

/// Reads a header. Nothing for a file that is not DICOM. Throws Failure(unreadable) for one that begins as DICOM but is damaged.
std::optional<DicomHeader> read_dicom_header(const std::filesystem::path& path);

}  // namespace palpate
