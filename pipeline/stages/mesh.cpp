// palpate-mesh: tetrahedra filling a closed surface, fine where a tool will touch.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/adapt_surface.hpp>
#include <pipeline/mesh/boundary.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/fill.hpp>
#include <pipeline/mesh/improve.hpp>
#include <pipeline/mesh/quality.hpp>
#include <pipeline/mesh/size_field.hpp>

using namespace palpate;

void usage(Usage& u) {
  u.name = "mesh";
  u.sentence = "Fills closed surfaces with tetrahedra, fine near the tool and coarse elsewhere.";
  u.details =
      "Without --edge and --focus the surface's triangles stay as they are. Otherwise they are split, collapsed, flipped and smoothed along the "
      "surface to the wanted edge lengths first (Botsch & Kobbelt 2004). gmsh fills the surface (Delaunay), then the worst tetrahedra are "
      "improved by smoothing, edge removal, swaps, contraction and splits (Freitag & Ollivier-Gooch 1997). The tetrahedra of each closed surface carry its region. A surface inside another that faces inward is a cavity; one of another region "
      "that faces outward is a body of its own inside the other. The boundary's triangles are stored as 2-D cells with regions "
      "\"<name>_surface\". Every check is made on the written file.";
  u.input("surface", "surface.vtp", "closed surfaces, triangles facing outward, region per triangle (palpate-surface)");
  u.output("mesh", "mesh.vtu", "tetrahedra with region, and the boundary's triangles with region names");
  u.real("edge", {}, "mm", {1e-3, 1e3}, "edge length away from the focus; default: the surface's own mean edge, and its triangles are kept");
  u.points("focus", "a point on the organ that a tool will touch: fine mesh around it");
  u.real("focus-edge", {}, "mm", {1e-3, 1e3}, "edge length around a focus; default: half the edge length elsewhere");
  u.real("focus-radius", {}, "mm", {0, 1e4}, "radius around a focus with the fine edge length; default: four fine edges");
  u.real("grading", {}, "mm", {0, 1e4}, "distance beyond the radius over which edges grow to their length elsewhere; default: four edges");
  u.real("min-dihedral", 8, "deg", {0, 60}, "smallest dihedral angle of a tetrahedron that is accepted");
  u.integer("max-tets", 20000000, {1, 1000000000}, "refuse, before meshing, when more tetrahedra than this are to be expected");
}

namespace {

SizeField sizes_from(const Command& c, const Surface& surface) {
  SizeField sizes;
  sizes.edge = c.has("edge") ? c.real("edge") : mean_edge(surface);
  sizes.focus = c.points("focus");
  sizes.focus_edge = sizes.focus.empty() ? sizes.edge : c.has("focus-edge") ? c.real("focus-edge") : sizes.edge / 2;
  sizes.focus_radius = c.has("focus-radius") ? c.real("focus-radius") : 4 * sizes.focus_edge;
  sizes.grading = c.has("grading") ? c.real("grading") : 4 * sizes.edge;
  return sizes;
}

void check_file(Command& c, const TetMesh& mesh, double surface_volume) {
  const QualityTable quality = quality_of(mesh);
  const MeshAudit found = audit(mesh);
  Check angle = check_at_least("smallest dihedral angle", quality.smallest_dihedral_deg.min, c.real("min-dihedral"), "deg");
  angle.where = "tetrahedron at " + place_text(centroid(corners_of(mesh, quality.worst_tet)));
  c.check(angle);
  c.check(check_equal("inverted tetrahedra", found.inverted_tets, 0));
  c.check(check_at_most("volume against the surface's", 100 * std::abs(found.volume_mm3 / surface_volume - 1), 1, "%"));
  c.check(check_equal("boundary triangles that are no face of one tetrahedron, or missing", found.unlisted_faces, 0));
  c.check(check_equal("open edges of the boundary", found.open_edges, 0));
  c.check(check_equal("unused nodes", found.unused_nodes, 0));
  c.check(check_equal("duplicate nodes", found.duplicate_nodes, 0));
  c.check(check_equal("regions without a name", found.unnamed_regions, 0));
  c.note("nodes", mesh.points.size());
  c.note("tets", mesh.tets.size());
  c.note("boundary_faces", mesh.faces.size());
  c.note("volume_mm3", found.volume_mm3);
  c.note("surface_volume_mm3", surface_volume);
  c.note("boundary_area_mm2", found.area_mm2);
  c.note("quality", to_json(quality));
}

}  // namespace

void run(Command& c) {
  const Surface given = without_unused_points(read_surface(c.input("surface")));
  const auto given_shells = closed_shells(given);
  const double volume = total_volume(given_shells, bodies_of(given, given_shells));
  const SizeField sizes = sizes_from(c, given);
  refuse_absurd(sizes, given, volume, c.integer("max-tets"));

  Progress progress = c.progress("mesh", 3);
  const bool everywhere = c.has("edge");
  const Surface surface = everywhere || !sizes.focus.empty()
                              ? adapt_surface(given, sizes, [&](const Vec3& x) { return everywhere || sizes.at(x) < sizes.edge; })
                              : given;
  progress.update(1, std::to_string(surface.triangles.size()) + " triangles");
  const auto shells = closed_shells(surface);
  Filling filling = fill(surface, shells, bodies_of(surface, shells), sizes);
  progress.update(2, std::to_string(filling.mesh.tets.size()) + " tetrahedra");
  for (const auto& message : filling.messages)
    if (c.verbose()) c.say("gmsh: " + message);
  c.note("improved", to_json(improve(filling.mesh, static_cast<int>(surface.points.size()), SurfaceIndex(surface))));
  name_boundary(filling.mesh, surface);
  progress.update(3);
  write_mesh(c.output("mesh"), filling.mesh);
  check_file(c, read_mesh(c.output("mesh")), volume);
}
