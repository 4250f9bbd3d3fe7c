// Reading a case: every name is looked up in the registers, every parameter has the range of its catalogue entry.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/case.hpp>

#include <algorithm>
#include <map>
#include <sstream>

#include <palpate/errors.hpp>
#include <solver/case_parts.hpp>
#include <solver/selection.hpp>

namespace palpate {

using Eigen::Vector3d;

std::string text_mm(const Vector3d& v) {
  std::ostringstream out;
  out << "(" << v.x() << ", " << v.y() << ", " << v.z() << ") mm";
  return out.str();
}

std::vector<std::string> region_names(const TetMesh& mesh) {
  std::vector<std::string> names;
  for (const auto& [region, name] : mesh.region_names) names.push_back(name);
  return names;
}

namespace {

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
  material.density = settings.real("density_kg_m3", 1050, {1e-3, 1e5});
  material.law = named(materials::all(), settings, "law");
  material.parameters = parameters(material.law.entry, settings);
  if (material.law.objection)
    if (const std::string objection = material.law.objection(material.parameters); !objection.empty())
      throw Failure(ExitCode::misuse, objection, settings.where());
  material.bulk_modulus = material.law.bulk_modulus(material.parameters);
  read_volume_energy(settings, material);
  return material;
}

/// The materials of the mesh's regions; one without a region is everybody's.
void read_materials(const Settings& settings, Case& c) {
  const auto tables = settings.tables("material");
  if (tables.empty()) settings.table("material");
  std::map<std::string, int> of_region;
  for (const auto& table : tables) {
    c.model.materials.push_back(read_material(table));
    c.material_regions.push_back(table.has("region") ? table.choice("region", region_names(c.mesh)) : "");
    const std::string& region = c.material_regions.back();
    if (region.empty() && tables.size() > 1)
      throw Failure(ExitCode::misuse, "one of several materials has no region", table.where(), "region = \"name of a label\"");
    if (!region.empty() && !of_region.emplace(region, of_region.size()).second)
      throw Failure(ExitCode::misuse, "two materials for one region", table.where("region"));
  }
  for (std::size_t t = 0; t < c.model.tets.size(); ++t) {
    if (of_region.empty()) {
      c.model.tet_material.push_back(0);
      continue;
    }
    const auto name = c.mesh.region_names.find(c.mesh.tet_region[t]);
    const auto found = name == c.mesh.region_names.end() ? of_region.end() : of_region.find(name->second);
    if (found == of_region.end())
      throw Failure(ExitCode::misuse, "region " + std::to_string(c.mesh.tet_region[t]) + " of the mesh has no material", settings.where("material"));
    c.model.tet_material.push_back(found->second);
  }
}

/// steps.times_s, or nothing for even ones.
void read_times(const Settings& steps, Case& c) {
  if (!steps.has("times_s")) return;
  if (steps.has("count")) throw Failure(ExitCode::misuse, "steps are given twice: count and times_s", steps.where("times_s"), "leave one out");
  c.steps.times = {0};
  for (double t : steps.reals("times_s")) {
    if (!(t > c.steps.times.back()))
      throw Failure(ExitCode::misuse, "times_s are not ascending, or not after 0", steps.where("times_s"), "times_s = [0.5, 1, 1.1, 2]");
    c.steps.times.push_back(t);
  }
  if (c.steps.times.size() == 1) throw Failure(ExitCode::misuse, "times_s is empty", steps.where("times_s"), "times_s = [0.5, 1, 1.1, 2]");
  c.count = static_cast<int>(c.steps.times.size()) - 1;
}

/// Even times, and those where a path has a corner.
void plan_times(double end, Case& c) {
  auto& times = c.steps.times;
  if (!times.empty()) return;
  for (int i = 0; i <= c.count; ++i) times.push_back(end * i / c.count);
  const auto add_corners = [&](const Amplitude& a) {
    for (const auto& point : a.points)
      if (point[0] > 0 && point[0] < end) times.push_back(point[0]);
  };
  for (const auto& tool : c.model.tools) add_corners(tool.ramp);
  for (const auto& amplitude : c.model.amplitudes) add_corners(amplitude);
  std::sort(times.begin(), times.end());
  const auto same = [&](double a, double b) { return b - a < 1e-9 * end; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  c.count = static_cast<int>(times.size()) - 1;
}

void read_steps(const Settings& settings, Case& c) {
  if (!settings.has("steps")) return;
  const Settings steps = settings.table("steps");
  read_times(steps, c);
  if (c.steps.times.empty()) c.count = static_cast<int>(steps.integer("count", c.count, {1, 10000}));
  c.steps.most_cuts = static_cast<int>(steps.integer("most_cuts", c.steps.most_cuts, {0, 20}));
  c.frames = static_cast<int>(steps.integer("frames", c.frames, {1, 10000}));
  c.keep_partial = steps.flag("keep_partial", false);
}

void read_remesh(const Settings& settings, Case& c) {
  if (!settings.has("remesh")) return;
  const Settings table = settings.table("remesh");
  c.remesh.emplace();
  c.remesh->part_of_radius = table.real("part_of_radius", c.remesh->part_of_radius, {0.01, 10});
  c.remesh->part_of_contact = table.real("part_of_contact", c.remesh->part_of_contact, {0.01, 10});
  c.remesh->least_shape = table.real("least_shape", c.remesh->least_shape, {0, 0.9});
  c.remesh->finest_mm = table.real("finest_mm", default_finest(c.model), {1e-3, 1e3});
  c.remesh->most = static_cast<int>(table.integer("most", c.remesh->most, {1, 1000}));
  c.remesh->most_nodes = static_cast<int>(table.integer("most_nodes", c.remesh->most_nodes, {4, 1000000}));
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

TetMesh rest_mesh(const Case& c) {
  TetMesh mesh = c.mesh;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.points[i] = {c.model.points[i].x(), c.model.points[i].y(), c.model.points[i].z()};
  return mesh;
}

Case read_case(const std::filesystem::path& path, const std::filesystem::path& mesh_override) {
  return read_case(Settings::read(path), mesh_override);
}

Case read_case(const Settings& settings, const std::filesystem::path& mesh_override) {
  settings.text("scheme", "implicit");
  if (settings.text("schema") != "palpate-case/1")
    throw Failure(ExitCode::misuse, "not a case this version reads", settings.where("schema"), "schema = \"palpate-case/1\"");
  Case c;
  const std::string mesh = settings.text("mesh", "mesh.vtu");
  c.mesh_path = mesh_override.empty() ? settings.file().parent_path() / mesh : mesh_override;
  read_steps(settings, c);
  c.mesh = read_mesh(c.mesh_path);
  copy_geometry(c.mesh, c.model, c.mesh_path);
  read_remesh(settings, c);
  read_materials(settings, c);
  read_effects(settings, c);
  read_loads(settings, c);
  read_contacts(settings, c);
  read_tools(settings, c);
  const double end = std::max(end_of_loads(c.model), 0.0);
  if (!(end > 0)) throw Failure(ExitCode::misuse, "nothing moves the organ", settings.where(), "[tool], [[displacement]] or [[force]]");
  plan_times(end, c);
  settings.expect_all_read();
  return c;
}

}  // namespace palpate
