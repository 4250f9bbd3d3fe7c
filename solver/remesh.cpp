// Files to palpate-remesh and back.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/remesh.hpp>

#include <algorithm>

#include <palpate/card.hpp>
#include <palpate/errors.hpp>
#include <solver/call_program.hpp>

namespace palpate {
namespace fs = std::filesystem;
namespace {

void write_deformed(const fs::path& path, const Case& c, const implicit::State& state, const std::vector<double>& marks) {
  TetMesh now = c.mesh;
  Field rest{"rest", 3, {}};
  for (std::size_t n = 0; n < now.points.size(); ++n) {
    rest.values.insert(rest.values.end(), now.points[n].begin(), now.points[n].end());
    for (int k = 0; k < 3; ++k) now.points[n][k] = c.model.points[n](k) + state.displacement(static_cast<int>(n))(k);
  }
  write_mesh(path, now, {rest}, {{"target_mm", 1, marks}});
}

const Field& named(const std::vector<Field>& fields, const std::string& name) {
  return *std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
}

implicit::Origins origins_of(const MeshFields& fields) {
  implicit::Origins origins;
  const auto &nodes = named(fields.on_points, "origin_nodes").values, &weights = named(fields.on_points, "origin_weights").values;
  for (std::size_t i = 0; i < nodes.size(); i += 4) {
    origins.nodes.push_back({int(nodes[i]), int(nodes[i + 1]), int(nodes[i + 2]), int(nodes[i + 3])});
    origins.weights.push_back({weights[i], weights[i + 1], weights[i + 2], weights[i + 3]});
  }
  for (double parent : named(fields.on_tets, "parent").values) origins.tets.push_back(static_cast<int>(parent));
  for (double parent : named(fields.on_faces, "parent").values) origins.faces.push_back(static_cast<int>(parent));
  return origins;
}

}  // namespace

implicit::Origins remeshed(const Case& c, const implicit::State& state, const std::vector<double>& marks, const fs::path& folder, const std::string& name) {
  const fs::path deformed = folder / "deformed.vtu", fresh = folder / "remeshed.vtu";
  write_deformed(deformed, c, state, marks);
  const int code = call_program("remesh", {deformed.string(), fresh.string(), "--quiet", "--force"});
  if (code != 0) throw Failure(ExitCode::defect, "palpate-remesh ended with exit code " + std::to_string(code), deformed.string());
  TetMesh mesh = read_mesh(fresh);
  const MeshFields fields = read_mesh_fields(fresh);
  const auto& rest = named(fields.on_points, "rest").values;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) mesh.points[n] = {rest[3 * n], rest[3 * n + 1], rest[3 * n + 2]};
  Field parent = named(fields.on_tets, "parent");
  const auto& of_faces = named(fields.on_faces, "parent").values;
  parent.values.insert(parent.values.end(), of_faces.begin(), of_faces.end());
  write_mesh(folder / name, mesh, {named(fields.on_points, "origin_nodes"), named(fields.on_points, "origin_weights")}, {parent});
  for (const fs::path& done : {deformed, fresh, card_path(fresh)}) fs::remove(done);
  return origins_of(fields);
}

Case case_on(const Settings& settings, const fs::path& mesh, const Case& before) {
  Case c = read_case(settings, mesh);
  c.mesh_path = before.mesh_path;
  c.remesh = before.remesh;  // its finest edge by default is of the first mesh
  for (std::size_t i = 0; i < c.model.tools.size(); ++i) c.model.tools[i].first_contact = before.model.tools[i].first_contact;
  return c;
}

}  // namespace palpate
