// palpate-idealize: the cylinder of the colon paper by numbers, or the cylinder or tube that fits a scanned lumen best.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/ideal_tube.hpp>

using namespace palpate;

void usage(Usage& u) {
  u.name = "idealize";
  u.sentence = "Makes a cylinder by numbers, or the cylinder or tube that fits a scanned organ best, and says how far it lies from it.";
  u.details =
      "Without --like: a straight cylinder along z by --diameter and --length (the colon paper's: outer diameter 25 mm, length 100 mm). With\n"
      "--like the numbers come from a surface: `cylinder` fits axis and radius by least squares over the wall's area; `tube` follows the centre\n"
      "line with one radius that gives the same volume. The wall is region \"wall\", the flat ends are \"end_1\" and \"end_2\". The card tells the\n"
      "Hausdorff distance, the root mean square and the volumes, and the diameter along the centre line.";
  u.output("surface", "cylinder.vtp", "closed triangle surface with regions wall, end_1, end_2");
  u.file("like", "a closed surface to idealise (palpate-surface); must be longer than wide");
  u.choice("shape", "cylinder", {"cylinder", "tube"}, "what to fit to --like");
  u.real("diameter", 25, "mm", {1e-3, 1e4}, "of the cylinder by numbers");
  u.real("length", 100, "mm", {1e-3, 1e5}, "of the cylinder by numbers");
  u.real("edge", 1, "mm", {1e-3, 1e3}, "edge length of the triangles");
}

namespace {

Json json(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// The tube around the centre line with the volume of what it is like.
Surface tube_like(const Surface& like, const CentreLine& line, double edge) {
  double radius = 0;
  for (double d : line.diameter) radius += d / 2 / line.diameter.size();
  Surface tube;
  for (int step = 0; step < 6; ++step) {
    tube = make_tube(line.points, radius, edge);
    radius *= std::sqrt(enclosed_volume(like) / enclosed_volume(tube));
  }
  return tube;
}

Surface idealized(Command& c, const Surface& like) {
  const CentreLine line = centre_line(like, 2 * c.real("edge"));
  c.note("centre_line", {{"arc_mm", line.arc}, {"diameter_mm", line.diameter}});
  if (c.text("shape") == "tube") return tube_like(like, line, c.real("edge"));
  const Cylinder fit = fit_cylinder(like, line);
  c.note("cylinder", {{"centre_mm", json(fit.centre)}, {"axis", json(fit.axis)}, {"diameter_mm", 2 * fit.radius}, {"length_mm", fit.length}});
  const Vec3 half = fit.length / 2 * fit.axis;
  return make_tube({fit.centre - half, fit.centre + half}, fit.radius, c.real("edge"));
}

}  // namespace

void run(Command& c) {
  if (!c.has("like")) {
    write_surface(c.output("surface"), make_tube({{0, 0, 0}, {0, 0, c.real("length")}}, c.real("diameter") / 2, c.real("edge")));
    return;
  }
  const Surface like = read_surface(c.file("like"));
  const Surface ideal = idealized(c, like);
  write_surface(c.output("surface"), ideal);
  const Difference d = difference(ideal, like);
  c.note("difference", {{"hausdorff_mm", d.hausdorff_mm}, {"worst_at_mm", json(d.worst_at)}, {"rms_mm", d.rms_mm},
                        {"volume_mm3", d.volume_mm3}, {"like_volume_mm3", d.other_volume_mm3}});
  c.check(check_at_least("volume", d.volume_mm3, 1e-9, "mm3"));
}
