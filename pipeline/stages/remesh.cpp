// palpate-remesh: a deformed mesh made finer where it is marked, every new node a material point of the old mesh.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <palpate/command.hpp>
#include <palpate/mesh_files.hpp>
#include <pipeline/mesh/boundary.hpp>
#include <pipeline/mesh/carried_fields.hpp>
#include <pipeline/mesh/cut.hpp>
#include <pipeline/mesh/quality.hpp>
#include <pipeline/mesh/refine.hpp>

using namespace palpate;

void usage(Usage& u) {
  u.name = "remesh";
  u.sentence = "Makes a deformed mesh finer where it is marked, or cuts it along a surface, and says where all of the new mesh lies in the old one.";
  u.details =
      "Marked are tetrahedra with a field target_mm above 0: they are bisected at their longest edges until none is longer than that, and\n"
      "their neighbours as far as it takes; without such a field all of them, to --edge. New nodes lie on old edges: volume and surface are kept,\n"
      "and so are regions and named faces. Fields of the points are carried along; one called rest is the places in the undeformed body, where\n"
      "elements must stay sound as well. Written with the new mesh: origin_nodes and origin_weights (a node is the sum of weights times old\n"
      "nodes), parent of every tetrahedron and face in the old mesh, -1 for the lips of a cut. palpate-solve calls this program while it runs.";
  u.input("mesh", "deformed.vtu", "tetrahedra where they are now; may carry target_mm on tetrahedra, rest and other fields on points");
  u.output("remeshed", "remeshed.vtu", "the new mesh with carried fields, origin_nodes, origin_weights and parent");
  u.file("cut", "a triangle surface (.vtp), open or closed, along which the mesh is cut as it is now: nodes there are doubled, the lips are the faces cut_1 (the side that the surface's normals point away from) and cut_2");
  u.real("edge", {}, "mm", {1e-3, 1e3}, "longest edge of the new mesh where there is no field target_mm; when not given, half of the longest edge, or with --cut what it is");
}

namespace {

void note_cut(Command& c, const CutReport& report, const TetMesh& before) {
  c.note("cut", {{"lip_faces", report.faces}, {"lip_area_mm2", report.area_mm2}, {"components", {{"before", components(before)}, {"after", report.components}}}});
}

}  // namespace

void run(Command& c) {
  const TetMesh before = read_mesh(c.input("mesh"));
  const MeshFields fields = read_mesh_fields(c.input("mesh"));
  const MeshAudit old_audit = audit(before);
  if (old_audit.inverted_tets > 0)
    throw Failure(ExitCode::unreadable, std::to_string(old_audit.inverted_tets) + " tetrahedra have no positive volume", c.input("mesh").string(), "mesh it again");
  CarriedMesh mesh(before, rest_places(fields, before));
  refine(mesh, targets(fields, before, c.has("edge") ? c.real("edge") : c.has("cut") ? 0 : longest_edge(before) / 2));
  CarriedMesh::Result result;
  if (c.has("cut")) note_cut(c, cut(std::move(mesh), read_surface(c.file("cut")), result), before);
  else result = mesh.result();
  const MeshAudit new_audit = audit(result.mesh);
  c.note("nodes", {{"before", before.points.size()}, {"after", result.mesh.points.size()}});
  c.note("tets", {{"before", before.tets.size()}, {"after", result.mesh.tets.size()}});
  c.note("volume_mm3", {{"before", old_audit.volume_mm3}, {"after", new_audit.volume_mm3}});
  c.note("quality", to_json(quality_of(result.mesh)));
  c.check(check_at_most("change of volume", std::abs(new_audit.volume_mm3 / old_audit.volume_mm3 - 1), 2e-3));
  c.check(check_equal("inverted tetrahedra", new_audit.inverted_tets, 0));
  c.check(check_equal("inverted tetrahedra at rest", inverted_at_rest(result), 0));
  c.check(check_equal("faces lost or without a tetrahedron", new_audit.unlisted_faces - old_audit.unlisted_faces, 0));
  write_carried(c.output("remeshed"), result, fields);
  c.print(std::to_string(before.tets.size()) + " -> " + std::to_string(result.mesh.tets.size()) + " tetrahedra, " + std::to_string(before.points.size()) +
          " -> " + std::to_string(result.mesh.points.size()) + " nodes");
}
