// palpate-import: one DICOM series of a folder as a scan in the patient's space.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <palpate/command.hpp>
#include <palpate/nifti.hpp>
#include <pipeline/image/dicom_folder.hpp>
#include <pipeline/image/dicom_geometry.hpp>
#include <pipeline/image/dicom_series.hpp>

void usage(palpate::Usage& u) {
  u.name = "import";
  u.sentence = "Reads one DICOM series of a folder, in any orientation and transfer syntax, into a scan in the patient's space.";
  u.details =
      "The folder is searched with everything below it; files that are not DICOM are counted and left out. Slices are ordered by their "
      "position along the normal, never by name, number or thickness, and rescaled one by one. Slices that are not evenly spaced, two "
      "images at one position, mixed sizes or orientations are refused with the place. A gantry tilt is kept exactly: the scan's third "
      "axis is then not at right angles to the slices.";
  u.input("dicom", "dicom", "folder with the series", palpate::ArgumentKind::folder);
  u.output("scan", "scan.nii.gz", "the scan, float32, rescaled");
  u.text("series", std::nullopt, "which series: its UID, number or description (or a part of the description); needed when the folder holds several");
}

void run(palpate::Command& c) {
  using namespace palpate;
  const DicomFolder folder = scan_dicom_folder(c.input("dicom"));
  const DicomSeries& series = choose_series(folder, c.has("series") ? c.text("series") : "");
  const SliceStack stack = stack_slices(series.frames);
  if (folder.foreign_files > 0) c.say(std::to_string(folder.foreign_files) + " files are not DICOM and were left out");
  for (const std::string& warning : stack.warnings) c.warn(warning);
  constexpr double visible_tilt_deg = 0.1;
  if (stack.tilt_deg > visible_tilt_deg) c.warn("the slices are sheared by a gantry tilt of " + std::to_string(stack.tilt_deg) + " deg; kept as it is");

  Progress progress = c.progress("import", stack.frames.size());
  const Scan scan = read_slices(stack, progress);
  write_scan(c.output("scan"), scan);

  const auto [darkest, brightest] = std::minmax_element(scan.voxels.begin(), scan.voxels.end());
  c.note("series", {{"uid", series.name.uid},
                    {"number", series.name.number},
                    {"description", series.name.description},
                    {"modality", series.name.modality},
                    {"body_part", series.name.body_part}});
  c.note("orientation", orientation_name(scan.grid));
  c.note("size", scan.grid.size);
  c.note("voxel_mm", {stack.frames.front().plane->column_step_mm, stack.frames.front().plane->row_step_mm, stack.pitch_mm});
  c.note("pitch_mm", stack.pitch_mm);
  c.note("tilt_deg", stack.tilt_deg);
  c.note("slices", stack.frames.size());
  c.note("intensity", {{"min", *darkest}, {"max", *brightest}});
  c.note("left_out", {{"not_dicom", folder.foreign_files}, {"without_image", folder.objects_without_image}});
  c.check(check_true("some contrast", *darkest < *brightest));
}
