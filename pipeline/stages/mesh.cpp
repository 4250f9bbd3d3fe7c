// palpate-mesh: tetrahedra filling a closed surface, or triangles of a thin wall, fine where a tool will touch.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>

#include <palpate/command.hpp>
#include <palpate/mesh_files.hpp>
#include <palpate/nifti.hpp>
#include <pipeline/mesh/adapt_surface.hpp>
#include <pipeline/mesh/boundary.hpp>
#include <pipeline/mesh/components.hpp>
#include <pipeline/mesh/fill.hpp>
#include <pipeline/mesh/improve.hpp>
#include <pipeline/mesh/improve_shell.hpp>
#include <pipeline/mesh/jaws_place.hpp>
#include <pipeline/mesh/open_tube.hpp>
#include <pipeline/mesh/quality.hpp>
#include <pipeline/mesh/shell_mesh.hpp>
#include <pipeline/mesh/shell_order.hpp>
#include <pipeline/mesh/shell_quality.hpp>
#include <pipeline/mesh/shell_thickness.hpp>
#include <pipeline/mesh/size_field.hpp>
#include <pipeline/mesh/wall_label.hpp>

using namespace palpate;

void usage(Usage& u) {
  u.name = "mesh";
  u.sentence = "Fills closed surfaces with tetrahedra, or makes a thin wall of triangles of a tube, fine near the tool and coarse elsewhere.";
  u.details =
      "Without --edge and --focus the surface's triangles stay as they are. Otherwise they are split, collapsed, flipped and smoothed along the "
      "surface to the wanted edge lengths first (Botsch & Kobbelt 2004). gmsh fills the surface (Delaunay), then the worst tetrahedra are "
      "improved by smoothing, edge removal, swaps, contraction and splits (Freitag & Ollivier-Gooch 1997). The tetrahedra of each closed surface carry its region; where its triangles have several (organs that hang together), that of the nearest triangle. A surface inside another that faces inward is a cavity; one of another region "
      "that faces outward is a body of its own inside the other. The boundary's triangles are stored as 2-D cells with regions "
      "\"<name>_surface\". Every check is made on the written file.\n"
      "--kind shell: the surface is a tube; regions \"end…\" are taken off, it is moved by --offset to the wall's mid-surface, cut at right angles to\n"
      "its centre line and meshed anew by gmsh. Sizes follow the distance along the centre line from the focus. Limits of the colon paper.";
  u.input("surface", "surface.vtp", "closed surfaces, triangles facing outward, region per triangle (palpate-surface)");
  u.output("mesh", "mesh.vtu", "tetrahedra with region, and the boundary's triangles with region names");
  u.real("edge", {}, "mm", {1e-3, 1e3}, "edge length away from the focus; default: the surface's own mean edge, and its triangles are kept");
  u.points("focus", "a point on the organ that a tool will touch: fine mesh around it");
  u.real("focus-edge", {}, "mm", {1e-3, 1e3}, "edge length around a focus; default: half the edge length elsewhere");
  u.real("focus-radius", {}, "mm", {0, 1e4}, "radius around a focus with the fine edge length; default: four fine edges");
  u.real("grading", {}, "mm", {0, 1e4}, "distance beyond the radius over which edges grow to their length elsewhere; default: four edges");
  u.real("jaws-place", {}, "mm", {0, 1e5}, "where jaws will close, along the centre line: a focus with folds; their centre_mm, axis and along are printed for the case's [clamp] (shell)");
  u.real("jaws-angle", 0, "deg", {-360, 360}, "of these jaws about the centre line, from the direction nearest to -Y (shell)");
  u.points("jaws-axis", "DX,DY,DZ: the way jaws will close on a tube at the focus; where it will fold, on both sides, edges are --fold-edge (shell)");
  u.real("fold-edge", {}, "mm", {1e-3, 1e3}, "edge length in these folds; default: 0.36 of --thickness, at most half of --focus-edge (shell)");
  u.real("min-dihedral", 8, "deg", {0, 60}, "smallest dihedral angle of a tetrahedron that is accepted");
  u.choice("kind", "solid", {"solid", "shell"}, "tetrahedra that fill the surface, or triangles of a thin wall");
  u.real("thickness", 1, "mm", {1e-3, 100}, "of the wall (shell)");
  u.real("offset", 0, "mm", {-100, 100}, "from the surface to the wall's mid-surface, outward: half the thickness for a lumen (shell)");
  u.real("cut-from", {}, "mm", {0, 1e5}, "where the tube begins, along its centre line; default: at its own end (shell)");
  u.real("cut-to", {}, "mm", {0, 1e5}, "where it ends; default: at its own end (shell)");
  u.file("wall", "labels.nii.gz: the wall's thickness and middle are measured from a label, along each node's normal, instead of --thickness (shell)");
  u.integer("wall-label", 1, {1, 65535}, "the label that is the wall");
  u.real("wall-reach", 5, "mm", {1e-3, 100}, "how far from the surface, moved by --offset, the label may lie (shell)");
  u.points("zone", "FROM,TO,FACTOR: between two places along the centre line the wall is so many times as thick; several are circular folds (shell)");
  u.real("zone-edge", 2, "mm", {1e-3, 1e3}, "width over which a zone's thickness changes, half of it inside (shell)");
  u.points("polyp", "X,Y,Z on the wall: the middle of a polyp, a bump of thickness (shell)");
  u.real("polyp-radius", 5, "mm", {1e-3, 1e3}, "of the polyps (shell)");
  u.real("polyp-height", 2, "mm", {-100, 100}, "thickness that is added in their middles (shell)");
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

/// Edges in a fold over those beside it. Folds get about as sharp as the wall is thick: with edges of 0.36 of it forces and stresses no longer hang on them (decision 054).
double fold_share(const Command& c, const SizeField& sizes, const std::vector<Vec3>& axes) {
  if (axes.size() != 1 || sizes.focus.empty() || !(norm(axes.front()) > 0))
    throw Failure(ExitCode::misuse, "--jaws-axis is one direction, and folds lie at a --focus", "", "--focus X,Y,Z --jaws-axis 0,-1,0");
  constexpr double of_the_thickness = 0.36;
  const double usual = c.has("wall") ? sizes.focus_edge / 2 : std::min(sizes.focus_edge / 2, of_the_thickness * c.real("thickness"));
  return std::min(1.0, (c.has("fold-edge") ? c.real("fold-edge") : usual) / sizes.focus_edge);
}

/// 3.6 mm away from the clamp keep every edge under the paper's 5.66 mm; 2 mm near it.
std::function<double(const Vec3&)> shell_sizes(const Command& c, const CentreLine& line) {
  SizeField sizes;
  sizes.edge = c.has("edge") ? c.real("edge") : 3.6;
  sizes.focus_edge = c.has("focus-edge") ? c.real("focus-edge") : std::min(2.0, sizes.edge);
  sizes.focus_radius = c.has("focus-radius") ? c.real("focus-radius") : 4 * sizes.focus_edge;
  sizes.grading = c.has("grading") ? c.real("grading") : 4 * sizes.edge;
  sizes.focus = c.points("focus");
  auto axes = c.points("jaws-axis");
  if (c.has("jaws-place")) {
    if (c.real("jaws-place") > line.length())
      throw Failure(ExitCode::misuse, "--jaws-place lies beyond the centre line's end at " + std::to_string(line.length()) + " mm", "", "a place along the tube");
    const JawsPlace jaws = jaws_at(line, c.real("jaws-place"), c.real("jaws-angle"));
    sizes.focus.push_back(jaws.centre);
    axes.push_back(jaws.axis);
  }
  std::vector<double> focus;
  for (const Vec3& x : sizes.focus) focus.push_back(line.project(x));
  const double in_folds = axes.empty() ? 1 : fold_share(c, sizes, axes), half_width = 1.5 * c.real("thickness");
  const Vec3 axis = axes.empty() ? Vec3{0, 0, 0} : axes.front();
  return [=](const Vec3& x) {
    double nearest = std::numeric_limits<double>::infinity();
    const double s = line.project(x);
    for (double f : focus) nearest = std::min(nearest, std::abs(s - f));
    const double edge = sizes.at_distance(nearest);
    if (in_folds == 1) return edge;
    const Vec3 t = line.tangent(s), across = unit(axis - dot(axis, t) * t);
    const double beside = std::max(0.0, std::abs(dot(x - line.at(s), across)) - half_width);
    const double away = std::max(beside / (2 * sizes.focus_edge), 2 * nearest / sizes.focus_radius - 1);  // from the folds, from the jaws
    return edge * (in_folds + (1 - in_folds) * std::clamp(away, 0.0, 1.0));
  };
}

/// `meshed`: area of the triangles on the surface, before any node went to a measured wall's middle.
void check_shell(Command& c, const ShellMesh& mesh, double area, double meshed) {
  const ShellQuality quality = shell_quality(mesh);
  c.check(check_at_most("longest edge", quality.worst.longest_edge, c.has("edge") ? std::sqrt(2) * c.real("edge") : 5.66, "mm"));
  c.check(check_at_most("skew", quality.worst.skew_deg, 77, "deg"));
  c.check(check_at_most("equiangular skew", quality.worst.equiangular_skew, 0.6));
  c.check(check_at_least("Jacobian", quality.worst.jacobian, 1));
  c.check(check_at_most("area against the surface's", 100 * std::abs(meshed / area - 1), 1, "%"));
  c.check(check_equal("rims", rims(mesh.triangles).size(), 2));
  c.note("nodes", mesh.points.size());
  c.note("triangles", mesh.triangles.size());
  c.note("surface_area_mm2", area);
  c.note("quality", to_json(mesh, quality));
}

void mesh_shell(Command& c) {
  const Surface tube = without_ends(without_unused_points(read_surface(c.input("surface"))));
  const CentreLine line = centre_line(tube, std::max(1.0, mean_edge(tube)));
  const double from = c.has("cut-from") ? c.real("cut-from") : 0, to = c.has("cut-to") ? c.real("cut-to") : line.length();
  if (c.has("cut-to") && to > line.length())
    throw Failure(ExitCode::misuse, "--cut-to lies beyond the centre line's end at " + std::to_string(line.length()) + " mm");
  Surface moved = moved_outward(tube, c.real("offset"));
  if (c.has("cut-from") || c.has("cut-to")) moved = cut_between(moved, line, c.has("cut-from") ? from : -1e5, c.has("cut-to") ? to : 1e5);
  double narrowest = line.length();
  for (std::size_t i = 0; i < line.arc.size(); ++i)
    if (line.arc[i] >= from && line.arc[i] <= to && i > 0 && i + 1 < line.arc.size()) narrowest = std::min(narrowest, line.diameter[i]);
  if (c.real("thickness") > narrowest / 2)
    throw Failure(ExitCode::misuse, "the wall is thicker than the tube's radius, " + std::to_string(narrowest / 2) + " mm at its narrowest", "", "a smaller --thickness");
  c.note("centre_line", {{"arc_mm", line.arc}, {"diameter_mm", line.diameter}, {"points_mm", line.points}});
  double area = 0;
  for (const auto& t : moved.triangles)
    area += norm(cross(moved.points[t[1]] - moved.points[t[0]], moved.points[t[2]] - moved.points[t[0]])) / 2;
  ShellMesh mesh = mesh_tube(moved, shell_sizes(c, line), c.real("thickness"));
  improve_shell(mesh, SurfaceIndex(moved), 10);
  order_along(mesh);
  const double meshed = shell_quality(mesh).area_mm2;
  if (c.has("wall")) {
    const MeasuredWall wall = measure_wall(mesh, read_labels(c.file("wall")), static_cast<int>(c.integer("wall-label")), c.real("wall-reach"));
    c.note("wall_label", {{"nodes_measured", wall.measured}, {"nodes_filled_from_neighbours", wall.filled}, {"farthest_move_mm", wall.farthest_move}});
  }
  std::vector<ThicknessZone> zones;
  for (const Vec3& z : c.points("zone")) {
    if (!(z[1] > z[0] && z[2] > 0)) throw Failure(ExitCode::misuse, "--zone is FROM,TO,FACTOR: two places in mm, ascending, and a positive factor");
    zones.push_back({z[0], z[1], z[2], c.real("zone-edge")});
  }
  std::vector<Polyp> polyps;
  for (const Vec3& x : c.points("polyp")) polyps.push_back({x, c.real("polyp-radius"), c.real("polyp-height")});
  vary_thickness(mesh, line, zones, polyps);
  const auto [thinnest, thickest] = std::minmax_element(mesh.thickness_mm.begin(), mesh.thickness_mm.end());
  if (!(*thinnest > 0)) throw Failure(ExitCode::misuse, "a polyp leaves no wall: " + std::to_string(*thinnest) + " mm", "", "--polyp-height above the wall's thickness, if negative");
  c.note("thickness_mm", {*thinnest, *thickest});
  write_shells(c.output("mesh"), mesh);
  check_shell(c, read_shells(c.output("mesh")), area, meshed);
  if (c.has("jaws-place")) c.print(clamp_lines(jaws_at(line, c.real("jaws-place"), c.real("jaws-angle"))));
}

}  // namespace

void run(Command& c) {
  if (c.text("kind") == "shell") return mesh_shell(c);
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
  const auto bodies = bodies_of(surface, shells);
  Filling filling = fill(surface, shells, bodies, sizes);
  progress.update(2, std::to_string(filling.mesh.tets.size()) + " tetrahedra");
  for (const auto& message : filling.messages)
    if (c.verbose()) c.say("gmsh: " + message);
  c.note("improved", to_json(improve(filling.mesh, static_cast<int>(surface.points.size()), SurfaceIndex(surface))));
  divide_by_nearest_triangle(filling.mesh, surface, shells, bodies);
  name_boundary(filling.mesh, surface);
  progress.update(3);
  write_mesh(c.output("mesh"), filling.mesh);
  check_file(c, read_mesh(c.output("mesh")), volume);
}
