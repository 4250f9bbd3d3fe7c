// Nodes of the surface by plane, box or label.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/selection.hpp>

#include <algorithm>

#include <palpate/errors.hpp>
#include <solver/case_parts.hpp>

namespace palpate {

using Eigen::Vector3d;

Vector3d eigen(const Vec3& v) { return {v[0], v[1], v[2]}; }

Vector3d direction(const Settings& settings, const std::string& key) {
  const Vector3d v = eigen(settings.vec3(key));
  if (!(v.norm() > 1e-9)) throw Failure(ExitCode::misuse, key + " has no direction", settings.where(key));
  return v.normalized();
}

std::set<int> boundary_nodes(const TetMesh& mesh) {
  std::set<int> nodes;
  for (const auto& f : mesh.faces) nodes.insert(f.begin(), f.end());
  return nodes;
}

namespace {

/// Boundary nodes on the far side of a plane: (x − point) · normal ≤ 0.
std::set<int> below_plane(const Settings& plane, const TetMesh& mesh) {
  const Vector3d point = eigen(plane.vec3("point_mm")), normal = direction(plane, "normal");
  std::set<int> chosen;
  for (int node : boundary_nodes(mesh))
    if ((eigen(mesh.points[node]) - point).dot(normal) <= 0) chosen.insert(node);
  return chosen;
}

std::set<int> in_box(const Settings& box, const TetMesh& mesh) {
  const Vector3d low = eigen(box.vec3("min_mm")), high = eigen(box.vec3("max_mm"));
  std::set<int> chosen;
  for (int node : boundary_nodes(mesh))
    if (const Vector3d x = eigen(mesh.points[node]); (x.array() >= low.array()).all() && (x.array() <= high.array()).all()) chosen.insert(node);
  return chosen;
}

std::set<int> with_label(const Settings& base, const TetMesh& mesh) {
  const std::string label = base.choice("label", region_names(mesh));
  std::set<int> chosen;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto found = mesh.region_names.find(mesh.face_region[f]);
    if (found != mesh.region_names.end() && found->second == label) chosen.insert(mesh.faces[f].begin(), mesh.faces[f].end());
  }
  return chosen;
}

}  // namespace

std::vector<int> chosen_faces(const Settings& settings, const TetMesh& mesh) {
  const auto nodes = chosen_nodes(settings, mesh);
  std::vector<int> faces;
  for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f) {
    const auto name = mesh.region_names.find(mesh.face_region[f]);
    const bool labelled = !settings.has("label") || (name != mesh.region_names.end() && name->second == settings.text("label"));
    if (labelled && std::all_of(mesh.faces[f].begin(), mesh.faces[f].end(), [&](int node) { return nodes.contains(node); })) faces.push_back(f);
  }
  if (faces.empty()) throw Failure(ExitCode::misuse, "no whole face is chosen", settings.where(), "enlarge the box, or move the plane");
  return faces;
}

std::set<int> chosen_nodes(const Settings& base, const TetMesh& mesh) {
  const int given = base.has("plane") + base.has("box") + base.has("label");
  if (given != 1) throw Failure(ExitCode::misuse, "surface nodes are chosen by one of plane, box, label", base.where(), "plane = { point_mm = [..], normal = [..] }");
  const auto chosen = base.has("plane") ? below_plane(base.table("plane"), mesh)
                      : base.has("box") ? in_box(base.table("box"), mesh)
                                        : with_label(base, mesh);
  if (chosen.size() < 3)
    throw Failure(ExitCode::misuse, std::to_string(chosen.size()) + " nodes of the surface are chosen", base.where(),
                  "at least three: move the plane or enlarge the box");
  return chosen;
}

}  // namespace palpate
