// palpate-surface: labels → closed, smooth, evenly triangulated surface, with a ledger of its volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/nifti.hpp>
#include <pipeline/surface/build_surface.hpp>
#include <pipeline/surface/checks.hpp>
#include <pipeline/surface/notes.hpp>

using namespace palpate;

void usage(Usage& u) {
  u.name = "surface";
  u.sentence =
      "Turns labels, or a triangle surface from elsewhere, into a smooth closed surface of even triangles that keeps the volume.";
  u.details =
      "The chosen labels are cut out, small pieces dropped and closed cavities filled. The voxels are blurred by a Gaussian wide "
      "enough to bridge "
      "the slices, and the surface is taken where it encloses exactly their volume; it is then remeshed to even triangles and "
      "its volume restored. "
      "A triangle surface (.vtp .stl .ply .obj) is repaired, its holes closed up to --hole, remeshed and smoothed instead. "
      "The written file is read again and checked: closed, manifold, oriented, free of self-intersections, volume within 2 %.";
  u.input("shape", "labels.nii.gz",
          "label volume (NIfTI), also one made elsewhere, zero is background; or a surface .vtp .stl .ply .obj in LPS, mm");
  u.output("surface", "surface.vtp", "closed triangle surface in patient LPS, mm; region of a triangle: the nearest label");
  u.text("labels", std::nullopt, "labels that make up the organ, as in 1,2; all above zero when not given");
  u.integer("pieces", std::nullopt, {1, 1000},
            "keep this many connected pieces, the largest; when not given, all that reach --min-piece");
  u.real("min-piece", 0.01, "1", {0, 1}, "smallest piece to keep, as a fraction of the largest");
  u.choice("cavities", "fill", {"fill", "keep"}, "what to do with cavities enclosed on all sides");
  u.real(
      "smooth", std::nullopt, "mm", {1e-3, 100},
      "standard deviation of the Gaussian; when not given, 1.5 times the coarsest voxel spacing and at least a third of --edge");
  u.real("edge", std::nullopt, "mm", {1e-3, 1000},
         "edge length of the triangles; when not given, a twentieth of the cube root of the largest piece's volume");
  u.real("hole", std::nullopt, "mm", {0, 1e4},
         "largest hole of a brought surface to close, across; when not given, a fifth of its bounding box's diagonal");
  u.integer("max-genus", std::nullopt, {0, 1000},
            "most handles (tunnels) the surface may have; when not given, they are only reported");
}

void run(Command& c) {
  SurfaceOptions options;
  options.mask.labels = c.has("labels") ? label_list(c.text("labels")) : std::set<int>{};
  options.mask.largest = c.has("pieces") ? int(c.integer("pieces")) : 0;
  options.mask.min_piece = c.real("min-piece");
  options.mask.keep_cavities = c.text("cavities") == "keep";
  if (c.has("smooth")) options.smooth_mm = c.real("smooth");
  if (c.has("edge")) options.edge_mm = c.real("edge");
  if (c.has("hole")) options.hole_mm = c.real("hole");
  const auto tell = [&](const std::string& message) { c.say(message); };
  const auto& shape = c.input("shape");
  SurfaceLedger ledger;
  Surface surface = is_surface_file(shape) ? rebuild_surface(read_brought_surface(shape), options, ledger, tell)
                                           : build_surface(read_labels(shape), options, ledger, tell);
  surface.region_names = region_names(c, surface);
  write_surface(c.output("surface"), surface);
  const Surface written = read_surface(c.output("surface"));
  SurfaceLimits limits;
  limits.volume_mm3 = is_surface_file(shape) ? ledger.raw_mm3 : ledger.voxels_mm3;
  if (c.has("pieces")) limits.components = int(c.integer("pieces"));
  if (c.has("max-genus")) limits.genus = int(c.integer("max-genus"));
  for (const Check& check : surface_checks(written, limits)) c.check(check);
  note_surface(c, written, ledger);
  for (const std::string& warning : warnings(ledger)) c.warn(warning);
}
