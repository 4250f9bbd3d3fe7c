// Reading a case: every name is looked up in the registers, every parameter has the range of its catalogue entry.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/case.hpp>

#include <algorithm>
#include <set>
#include <sstream>

#include <palpate/errors.hpp>

namespace palpate {
namespace {

using Eigen::Vector3d;

Vector3d eigen(const Vec3& v) { return {v[0], v[1], v[2]}; }

std::string text_mm(const Vector3d& v) {
  std::ostringstream out;
  out << "(" << v.x() << ", " << v.y() << ", " << v.z() << ") mm";
  return out.str();
}

template <class Entry>
const Entry& named(const std::vector<Entry>& entries, const Settings& settings, const std::string& key) {
  std::vector<std::string> names;
  for (const auto& e : entries) names.push_back(e.entry.name);
  const std::string name = settings.choice(key, names);
  return *std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.entry.name == name; });
}

std::vector<double> parameters(const CatalogueEntry& entry, const Settings& settings) {
  std::vector<double> values;
  for (const auto& p : entry.parameters) values.push_back(settings.real(p.name, p.range));
  return values;
}

Vector3d direction(const Settings& settings, const std::string& key) {
  const Vector3d v = eigen(settings.vec3(key));
  if (!(v.norm() > 1e-9)) throw Failure(ExitCode::misuse, key + " has no direction", settings.where(key));
  return v.normalized();
}

/// The volume energy: κ from `kappa`, or Σ (J − 1)^(2i)/D_i from `D1`, … where the law's source writes it so (D1 = 2/κ).
void read_volume_energy(const Settings& settings, elements::Material& material) {
  const auto& law = material.law;
  const auto given = [&](int i) { return i <= law.volume_terms && settings.has("D" + std::to_string(i)); };
  if (settings.has("kappa") && std::isfinite(material.bulk_modulus))
    throw Failure(ExitCode::misuse, "kappa is given twice: " + law.entry.name + " has nu", settings.where("kappa"));
  if (settings.has("kappa") && given(1))
    throw Failure(ExitCode::misuse, "the bulk modulus is given twice: kappa and D1 = 2/kappa", settings.where("D1"),
                  "leave one out");
  if (settings.has("kappa")) material.bulk_modulus = settings.real("kappa", {1e-9, 1e9});
  if (given(1)) material.bulk_modulus = 2 / settings.real("D1", {1e-9, 1e9});
  for (int i : {2, 3}) {
    const std::string key = "D" + std::to_string(i);
    if (!given(i)) continue;
    if (!std::isfinite(material.bulk_modulus))
      throw Failure(ExitCode::misuse, key + " without D1: the law is incompressible, nothing else counts", settings.where(key),
                    "add D1 or kappa");
    material.volume_stiffening[i - 2] = 1 / settings.real(key, {1e-9, 1e9});
  }
}

elements::Material read_material(const Settings& settings) {
  elements::Material material;
  material.law = named(materials::all(), settings, "law");
  material.parameters = parameters(material.law.entry, settings);
  if (material.law.objection)
    if (const std::string objection = material.law.objection(material.parameters); !objection.empty())
      throw Failure(ExitCode::misuse, objection, settings.where());
  material.bulk_modulus = material.law.bulk_modulus(material.parameters);
  read_volume_energy(settings, material);
  return material;
}

std::set<int> boundary_nodes(const TetMesh& mesh) {
  std::set<int> nodes;
  for (const auto& f : mesh.faces) nodes.insert(f.begin(), f.end());
  return nodes;
}

/// Boundary nodes on the far side of a plane: (x − point) · normal ≤ 0.
std::set<int> below_plane(const Settings& plane, const TetMesh& mesh, const std::vector<Vector3d>& points) {
  const Vector3d point = eigen(plane.vec3("point_mm")), normal = direction(plane, "normal");
  std::set<int> chosen;
  for (int node : boundary_nodes(mesh))
    if ((points[node] - point).dot(normal) <= 0) chosen.insert(node);
  return chosen;
}

std::set<int> in_box(const Settings& box, const TetMesh& mesh, const std::vector<Vector3d>& points) {
  const Vector3d low = eigen(box.vec3("min_mm")), high = eigen(box.vec3("max_mm"));
  std::set<int> chosen;
  for (int node : boundary_nodes(mesh))
    if ((points[node].array() >= low.array()).all() && (points[node].array() <= high.array()).all()) chosen.insert(node);
  return chosen;
}

std::set<int> with_label(const Settings& base, const TetMesh& mesh) {
  std::vector<std::string> names;
  for (const auto& [region, name] : mesh.region_names) names.push_back(name);
  const std::string label = base.choice("label", names);
  std::set<int> chosen;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto found = mesh.region_names.find(mesh.face_region[f]);
    if (found != mesh.region_names.end() && found->second == label) chosen.insert(mesh.faces[f].begin(), mesh.faces[f].end());
  }
  return chosen;
}

std::set<int> base_nodes(const Settings& base, const TetMesh& mesh, const std::vector<Vector3d>& points) {
  const int given = base.has("plane") + base.has("box") + base.has("label");
  if (given != 1) throw Failure(ExitCode::misuse, "a base is one of plane, box, label", base.where(), "plane = { point_mm = [..], normal = [..] }");
  const auto chosen = base.has("plane") ? below_plane(base.table("plane"), mesh, points)
                      : base.has("box") ? in_box(base.table("box"), mesh, points)
                                        : with_label(base, mesh);
  if (chosen.size() < 3)
    throw Failure(ExitCode::misuse, "the base holds " + std::to_string(chosen.size()) + " nodes of the organ's surface", base.where(),
                  "at least three: move the plane or enlarge the box");
  return chosen;
}

contact::Tool read_tool(const Settings& settings, const TetMesh& mesh, const std::vector<Vector3d>& points, Vector3d& aim) {
  contact::Tool tool;
  tool.shape = named(tools::all(), settings, "kind");
  tool.parameters = parameters(tool.shape.entry, settings);
  tool.axis = direction(settings, "axis");
  tool.depth = settings.real("depth_mm", {1e-6, 1e3});
  aim = eigen(settings.vec3("aim_mm"));
  std::vector<Vector3d> surface;
  Eigen::AlignedBox3d box;
  for (int node : boundary_nodes(mesh)) {
    surface.push_back(points[node]);
    box.extend(points[node]);
  }
  for (const auto& f : mesh.faces) surface.push_back((points[f[0]] + points[f[1]] + points[f[2]]) / 3);
  if (!contact::find_first_contact(tool, aim, surface))
    throw Failure(ExitCode::misuse, "the tool misses the organ: its line through " + text_mm(aim) + " does not meet it", settings.where("aim_mm"),
                  "aim inside the organ's box, " + text_mm(box.min()) + " to " + text_mm(box.max()));
  return tool;
}

void copy_geometry(const TetMesh& mesh, implicit::Model& model, const std::filesystem::path& path) {
  for (const auto& p : mesh.points) model.points.push_back(eigen(p));
  model.tets = mesh.tets;
  model.faces = mesh.faces;
  if (model.tets.empty() || model.faces.empty())
    throw Failure(ExitCode::unreadable, "the mesh has no " + std::string(model.tets.empty() ? "tetrahedra" : "boundary faces"), path.string(),
                  "palpate-mesh writes both");
  std::vector<char> used(model.points.size(), 0);
  for (std::size_t t = 0; t < model.tets.size(); ++t) {
    Eigen::Matrix<double, 3, 4> X;
    for (int a = 0; a < 4; ++a) {
      X.col(a) = model.points[model.tets[t][a]];
      used[model.tets[t][a]] = 1;
    }
    try {
      elements::tetrahedron(X);
    } catch (const std::domain_error& error) {
      throw Failure(ExitCode::unreadable, "tetrahedron " + std::to_string(t) + " has no positive volume",
                    path.string() + " at " + text_mm(X.rowwise().mean()), "mesh it again");
    }
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
    throw Failure(ExitCode::unreadable, "node " + std::to_string(unused - used.begin()) + " belongs to no tetrahedron", path.string(), "mesh it again");
}

}  // namespace

Case read_case(const std::filesystem::path& path, const std::filesystem::path& mesh_override) {
  const Settings settings = Settings::read(path);
  if (settings.text("schema") != "palpate-case/1")
    throw Failure(ExitCode::misuse, "not a case this version reads", settings.where("schema"), "schema = \"palpate-case/1\"");
  Case c;
  const std::string mesh = settings.text("mesh", "mesh.vtu");
  c.mesh_path = mesh_override.empty() ? path.parent_path() / mesh : mesh_override;
  const Settings material = settings.table("material"), base = settings.table("base"), tool = settings.table("tool");
  c.model.materials = {read_material(material)};
  c.speed_mm_s = tool.real("speed_mm_s", 1.0, {1e-6, 1e6});
  if (settings.has("steps")) {
    const Settings steps = settings.table("steps");
    c.steps.count = static_cast<int>(steps.integer("count", c.steps.count, {1, 10000}));
    c.steps.most_cuts = static_cast<int>(steps.integer("most_cuts", c.steps.most_cuts, {0, 20}));
    c.frames = static_cast<int>(steps.integer("frames", c.frames, {1, 10000}));
    c.keep_partial = steps.flag("keep_partial", false);
  }
  c.mesh = read_mesh(c.mesh_path);
  copy_geometry(c.mesh, c.model, c.mesh_path);
  c.model.tet_material.assign(c.model.tets.size(), 0);
  const auto held = base_nodes(base, c.mesh, c.model.points);
  c.base_nodes = static_cast<int>(held.size());
  for (int node : held)
    for (int component = 0; component < 3; ++component) c.model.prescribed.push_back({node, component, 0});
  c.model.tool = read_tool(tool, c.mesh, c.model.points, c.aim_mm);
  settings.expect_all_read();
  return c;
}

}  // namespace palpate
