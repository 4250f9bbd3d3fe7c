// Reading headers with GDCM: single-frame images, and enhanced multi-frame ones by their functional groups (PS3.3 C.7.6.16).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/image/dicom_header.hpp>

#include <gdcmMediaStorage.h>
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>

#include <fstream>

#include <palpate/errors.hpp>
#include <pipeline/image/dicom_values.hpp>
#include <pipeline/image/quiet_stderr.hpp>
#include <pipeline/image/watched_file.hpp>

namespace palpate {
namespace {

using gdcm::DataSet;
using gdcm::Tag;

const Tag shared_groups(0x5200, 0x9229), per_frame_groups(0x5200, 0x9230);

/// "DICM" behind a preamble of 128 bytes.
bool has_dicom_magic(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  char head[132] = {};
  return file.read(head, sizeof head) && std::string(head + 128, 4) == "DICM";
}

/// Objects whose pixels are no picture of a patient's inside: segmentations and their kin, maps of real numbers, doses.
bool is_derived_object(const std::string& sop_class) {
  return sop_class.starts_with("1.2.840.10008.5.1.4.1.1.66.") || sop_class == "1.2.840.10008.5.1.4.1.1.30" ||
         sop_class == "1.2.840.10008.5.1.4.1.1.481.2";
}

/// By its class, of the data set or of the file's head; where there is none, by its modality.
bool should_have_pixels(const gdcm::File& file, const std::string& modality) {
  gdcm::MediaStorage storage;
  if (storage.SetFromFile(file)) return gdcm::MediaStorage::IsImage(storage);
  return modality == "CT" || modality == "MR" || modality == "PT" || modality == "NM" || modality == "US";
}

/// Looks where a frame's facts may be: its own functional group, the shared one, the file's top level.
class Groups {
 public:
  Groups(const DataSet& top, const DataSet* shared, const DataSet* own) : levels_{own, shared}, top_(top) {}

  /// Numbers of `tag` inside the macro sequence `macro`, or at the top.
  std::optional<std::vector<double>> numbers(Tag macro, Tag tag) const {
    for (const DataSet* level : levels_) {
      if (!level) continue;
      const auto items = sequence_value(*level, macro);
      if (!items) continue;
      if (auto values = number_values(items->GetItem(1).GetNestedDataSet(), tag)) return values;
    }
    return number_values(top_, tag);
  }
  double number(Tag macro, Tag tag, double fallback) const {
    const auto values = numbers(macro, tag);
    return values ? values->front() : fallback;
  }

 private:
  const DataSet* levels_[2];
  const DataSet& top_;
};

const Tag plane_position(0x0020, 0x9113), plane_orientation(0x0020, 0x9116), pixel_measures(0x0028, 0x9110), value_transformation(0x0028, 0x9145);

void read_plane(const Groups& groups, DicomFrame& frame) {
  const auto position = groups.numbers(plane_position, Tag(0x0020, 0x0032));
  const auto orientation = groups.numbers(plane_orientation, Tag(0x0020, 0x0037));
  const auto spacing = groups.numbers(pixel_measures, Tag(0x0028, 0x0030));
  if (!position || position->size() != 3) frame.missing = "no ImagePositionPatient (0020,0032)";
  else if (!orientation || orientation->size() != 6) frame.missing = "no ImageOrientationPatient (0020,0037)";
  else if (!spacing || spacing->size() != 2) frame.missing = "no PixelSpacing (0028,0030)";
  else if (!(spacing->at(0) > 0 && spacing->at(1) > 0)) frame.missing = "PixelSpacing (0028,0030) is not positive";
  if (!frame.missing.empty()) return;
  const Vec3 row{orientation->at(0), orientation->at(1), orientation->at(2)}, column{orientation->at(3), orientation->at(4), orientation->at(5)};
  if (!(std::abs(norm(row) - 1) < 0.01 && std::abs(norm(column) - 1) < 0.01 && std::abs(dot(row, column)) < 0.01)) {
    frame.missing = "ImageOrientationPatient (0020,0037) is not two unit vectors at right angles";
    return;
  }
  frame.plane = FramePlane{{position->at(0), position->at(1), position->at(2)}, unit(row), unit(column), spacing->at(1), spacing->at(0)};
}

DicomFrame read_frame(const Groups& groups, DicomFrame frame) {
  frame.slope = groups.number(value_transformation, Tag(0x0028, 0x1053), 1);
  frame.intercept = groups.number(value_transformation, Tag(0x0028, 0x1052), 0);
  if (frame.slope == 0) frame.slope = 1;
  frame.thickness_mm = groups.number(pixel_measures, Tag(0x0018, 0x0050), 0);
  frame.spacing_between_mm = groups.number(pixel_measures, Tag(0x0018, 0x0088), 0);
  read_plane(groups, frame);
  return frame;
}

std::vector<DicomFrame> read_frames(const DataSet& data, const std::filesystem::path& path) {
  DicomFrame frame;
  frame.file = path;
  frame.rows = short_value(data, Tag(0x0028, 0x0010)).value_or(0);
  frame.columns = short_value(data, Tag(0x0028, 0x0011)).value_or(0);
  frame.frames = static_cast<int>(number_value(data, Tag(0x0028, 0x0008)).value_or(1));
  frame.localizer = text_value(data, Tag(0x0008, 0x0008)).find("LOCALIZER") != std::string::npos;
  if (frame.rows == 0 || frame.columns == 0) return {};
  if (frame.frames < 1 || frame.frames > 100000) throw Failure(ExitCode::unreadable, "damaged: NumberOfFrames (0028,0008)", path.string());
  const auto shared = sequence_value(data, shared_groups), own = sequence_value(data, per_frame_groups);
  if (own && static_cast<int>(own->GetNumberOfItems()) != frame.frames)
    throw Failure(ExitCode::unreadable, "damaged: " + std::to_string(frame.frames) + " frames, but positions of " + std::to_string(own->GetNumberOfItems()), path.string());
  std::vector<DicomFrame> frames;
  for (int i = 0; i < frame.frames; ++i) {
    frame.index = i;
    const Groups groups(data, shared ? &shared->GetItem(1).GetNestedDataSet() : nullptr, own ? &own->GetItem(i + 1).GetNestedDataSet() : nullptr);
    frames.push_back(read_frame(groups, frame));
    if (frame.frames > 1 && !own) {
      frames.back().plane.reset();
      frames.back().missing = "several frames, but no position of each (5200,9230)";
    }
  }
  return frames;
}

}  // namespace

std::string DicomFrame::name() const {
  return file.string() + (frames > 1 ? " frame " + std::to_string(index + 1) : "");
}

std::optional<DicomHeader> read_dicom_header(const std::filesystem::path& path) {
  silence_gdcm();
  const QuietStderr quiet;
  const bool magic = has_dicom_magic(path);
  WatchedFile file(path);
  gdcm::Reader reader;
  reader.SetStream(file.stream());
  bool complete = false;
  try {
    complete = (magic || reader.CanRead()) && reader.ReadUpToTag(Tag(0x7fe0, 0x0010));
  } catch (const std::exception&) {
    complete = false;
  }
  const bool deflated = reader.GetFile().GetHeader().GetDataSetTransferSyntax() == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian;
  if (magic && (!complete || (file.ended_early() && !deflated)))  // inflating reads ahead
    throw Failure(ExitCode::unreadable, "a damaged or truncated DICOM file", path.string(), "copy it again from its source, or move it out of the folder");
  if (!complete) return std::nullopt;
  const DataSet& data = reader.GetFile().GetDataSet();
  DicomHeader header;
  header.sop_class = text_value(data, Tag(0x0008, 0x0016));
  header.series = {text_value(data, Tag(0x0020, 0x000e)), text_value(data, Tag(0x0020, 0x0011)), text_value(data, Tag(0x0008, 0x103e)),
                   text_value(data, Tag(0x0008, 0x0060)), text_value(data, Tag(0x0020, 0x000d)), text_value(data, Tag(0x0018, 0x0015))};
  if (is_derived_object(header.sop_class)) return header;
  const bool has_pixels = data.FindDataElement(Tag(0x7fe0, 0x0010));
  if (!has_pixels && should_have_pixels(reader.GetFile(), header.series.modality))
    throw Failure(ExitCode::unreadable, "an image without pixel data: truncated?", path.string(), "copy it again from its source, or move it out of the folder");
  if (has_pixels) header.frames = read_frames(data, path);
  return header;
}

}  // namespace palpate
