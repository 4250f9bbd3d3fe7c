// palpate-phantom: a synthetic organ as a DICOM MR series, and the exact truth about it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/card.hpp>
#include <palpate/command.hpp>
#include <palpate/json.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/nifti.hpp>
#include <pipeline/image/dicom_write.hpp>
#include <pipeline/image/phantom_scan.hpp>
#include <pipeline/image/phantom_spec.hpp>
#include <pipeline/image/phantom_truth.hpp>

void usage(palpate::Usage& u) {
  u.name = "phantom";
  u.sentence = "Makes a kidney, a colon or a uterus with tube and ovary from analytic implicit shapes, as a DICOM MR series with noise, and writes the exact truth.";
  u.details =
      "The spec is TOML with schema = \"palpate-phantom/1\", one table [kidney], [colon] or [uterus], and optional tables [pose] (rotation_deg, "
      "centre_mm) and [scan] (plane, rotation_deg or row_direction and column_direction, voxel_mm, slice_thickness_mm, margin_mm, "
      "background, noise, bias, supersampling). The truth folder holds labels.nii.gz (1: the organ), parts.nii.gz (tissues), "
      "surface.vtp (the exact boundary) and truth.json (volumes, area, box, seed, where a tool enters). UIDs follow from spec and seed.";
  u.input("spec", "phantom.toml", "what to make: organ, pose and scan");
  u.output("dicom", "dicom", "the MR series, one file per slice", palpate::ArgumentKind::folder);
  u.output("truth", "truth", "labels, parts, surface and facts", palpate::ArgumentKind::folder);
}

void run(palpate::Command& c) {
  using namespace palpate;
  const PhantomSpec spec = read_phantom_spec(c.input("spec"));
  Progress progress = c.progress("phantom", 3);
  const PhantomImages images = render(spec, c.seed(), c.threads());
  progress.update(1, "scan");

  SeriesFacts series;
  series.identity = sha256(c.input("spec")) + "/" + std::to_string(c.seed());
  series.patient_name = "Phantom^" + spec.organ.name;
  series.description = spec.title;
  series.body_part = spec.organ.body_part;
  series.laterality = spec.organ.laterality;
  series.slice_thickness_mm = spec.scan.slice_thickness_mm;
  write_mr_series(c.output("dicom"), images.scan, series);
  progress.update(2, "series");

  const auto truth = c.output("truth");
  const Surface surface = truth_surface(spec.organ, c.threads());
  const Json facts = truth_facts(spec, images.scan.grid, surface, c.threads());
  write_labels(truth / "labels.nii.gz", images.organ);
  write_labels(truth / "parts.nii.gz", images.parts);
  write_surface(truth / "surface.vtp", surface);
  write_json(truth / "truth.json", facts);
  progress.update(3, "truth");

  double labelled = 0;
  for (auto label : images.organ.voxels) labelled += label;
  const double volume = facts["volume_mm3"].get<double>();
  c.check(check_at_most("integration error of the volume", facts["volume_error_mm3"].get<double>() / volume, 1e-3, "of the volume"));
  c.note("organ", spec.organ.name);
  c.note("volume_mm3", volume);
  c.note("labelled_mm3", labelled * images.scan.grid.voxel_mm3());
  c.note("size", images.scan.grid.size);
  c.note("voxel_mm", spec.scan.voxel_mm);
  c.note("seed_mm", spec.organ.seed);
  c.note("press", facts["press"]);
}
