// Fields of a mesh file to and from a mesh under change.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/carried_fields.hpp>

#include <algorithm>

#include <palpate/errors.hpp>
#include <pipeline/mesh/quality.hpp>

namespace palpate {
namespace {

const Field* named(const std::vector<Field>& fields, const std::string& name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

Field carried(const Field& old, const std::vector<Origin>& origins) {
  Field field{old.name, old.components, {}};
  for (const auto& origin : origins)
    for (int c = 0; c < old.components; ++c) {
      double sum = 0;
      for (int i = 0; i < 4; ++i)
        if (origin.weights[i] != 0) sum += origin.weights[i] * old.values[old.components * origin.nodes[i] + c];
      field.values.push_back(sum);
    }
  return field;
}

}  // namespace

std::vector<Vec3> rest_places(const MeshFields& fields, const TetMesh& mesh) {
  const Field* rest = named(fields.on_points, "rest");
  if (!rest) return {};
  if (rest->components != 3) throw Failure(ExitCode::unreadable, "the field rest has not three components", "the mesh", "places in the undeformed body, mm");
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) places.push_back({rest->values[3 * i], rest->values[3 * i + 1], rest->values[3 * i + 2]});
  return places;
}

std::vector<double> targets(const MeshFields& fields, const TetMesh& mesh, double otherwise) {
  const Field* target = named(fields.on_tets, "target_mm");
  return target ? target->values : std::vector<double>(mesh.tets.size(), otherwise);
}

double longest_edge(const TetMesh& mesh) {
  double longest = 0;
  for (const auto& tet : mesh.tets)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) longest = std::max(longest, norm(mesh.points[tet[i]] - mesh.points[tet[j]]));
  return longest;
}

long inverted_at_rest(const CarriedMesh::Result& result) {
  if (result.rest.empty()) return 0;
  return std::count_if(result.mesh.tets.begin(), result.mesh.tets.end(), [&](const auto& t) {
    return !(jacobian({result.rest[t[0]], result.rest[t[1]], result.rest[t[2]], result.rest[t[3]]}) > 0);
  });
}

void write_carried(const std::filesystem::path& path, const CarriedMesh::Result& result, const MeshFields& old) {
  Field nodes{"origin_nodes", 4, {}}, weights{"origin_weights", 4, {}}, parent{"parent", 1, {}};
  for (const auto& origin : result.origins) {
    nodes.values.insert(nodes.values.end(), origin.nodes.begin(), origin.nodes.end());
    weights.values.insert(weights.values.end(), origin.weights.begin(), origin.weights.end());
  }
  parent.values.assign(result.tet_parents.begin(), result.tet_parents.end());
  parent.values.insert(parent.values.end(), result.face_parents.begin(), result.face_parents.end());
  std::vector<Field> on_points;
  for (const auto& field : old.on_points)
    if (!field.name.starts_with("origin_")) on_points.push_back(carried(field, result.origins));
  on_points.push_back(std::move(nodes));
  on_points.push_back(std::move(weights));
  write_mesh(path, result.mesh, on_points, {parent});
}

}  // namespace palpate
