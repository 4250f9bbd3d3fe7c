// Reading it: laws by their names and ranges in the catalogue, the clamp, the ends, the steps.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/case.hpp>

#include <algorithm>

#include <palpate/errors.hpp>
#include <solver/case_parts.hpp>
#include <solver/explicit/case_effects.hpp>
#include <solver/selection.hpp>

namespace palpate::explicit_shell {
namespace {

using Eigen::Vector3d;

/// Which laws have a form for plane stress, and how their parameters go in.
const std::vector<std::pair<std::string, ShellLaw (*)(const std::vector<double>&)>> shell_laws{
    {"neo_hookean", [](const std::vector<double>& p) -> ShellLaw { return materials::NeoHookeanShell{p[0]}; }},
    {"mooney_rivlin", [](const std::vector<double>& p) -> ShellLaw { return materials::MooneyRivlinShell{p[0], p[1]}; }},
    {"yeoh", [](const std::vector<double>& p) -> ShellLaw { return materials::YeohShell{p[0], p[1], p[2]}; }},
    {"fung_demiray", [](const std::vector<double>& p) -> ShellLaw { return materials::FungDemirayShell{p[0], p[1]}; }},
    {"ogden", [](const std::vector<double>& p) -> ShellLaw { return materials::OgdenShell{{p[0], p[2], p[4]}, {p[1], p[3], p[5]}}; }},
    {"hooke", [](const std::vector<double>& p) -> ShellLaw { return materials::HookeShell{p[0], p[1]}; }}};

/// The same law for thin walls, and in three dimensions for effects.
ShellLaw read_law(const Settings& settings, Json& facts, elements::Material& solid) {
  std::vector<std::string> names;
  for (const auto& [name, make] : shell_laws) names.push_back(name);
  const std::string name = settings.choice("law", names);
  const auto laws = materials::all();
  const auto& law = named(laws, settings, "law");
  const auto values = parameters(law.entry, settings);
  for (const char* key : {"kappa", "D1", "D2", "D3"})
    if (settings.has(key))
      throw Failure(ExitCode::misuse, std::string(key) + ": thin walls keep their volume, the thickness follows from the stretch", settings.where(key), "leave it out");
  facts["law"] = name;
  solid = {law, values, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < values.size(); ++i) facts["parameters"][law.entry.parameters[i].name] = values[i];
  return std::find_if(shell_laws.begin(), shell_laws.end(), [&](const auto& l) { return l.first == name; })->second(values);
}

Clamp read_clamp(const Settings& s, const ShellMesh& mesh) {
  Clamp c;
  c.centre = eigen(s.vec3("centre_mm"));
  c.axis = eigen(s.vec3("axis", {0, -1, 0})).normalized();
  c.along = eigen(s.vec3("along", {0, 0, 1})).normalized();
  if (!(c.axis.cross(c.along).norm() > 0.1)) throw Failure(ExitCode::misuse, "the jaws' axis runs along the tube", s.where("axis"), "along = the tube's direction");
  c.width = s.real("width_mm", c.width, {1e-3, 1e4});
  c.length = s.real("length_mm", c.length, {1e-3, 1e4});
  c.height = s.real("height_mm", c.height, {1e-3, 1e4});
  c.edge_radius = s.real("edge_radius_mm", c.edge_radius, {1e-4, 1e3});
  const double thickest = *std::max_element(mesh.thickness_mm.begin(), mesh.thickness_mm.end());
  c.gap = s.has("gap_mm") ? s.real("gap_mm", {0, 1e4}) : 2 * thickest + s.real("margin_mm", 0.2, {0, 1e3});
  if (s.has("open_mm")) c.open = s.real("open_mm", {1e-3, 1e4});
  if (s.has("friction")) c.tractions.push_back({effects::friction(), {s.real("friction", {0, 10})}});
  if (s.has("pressure_MPa")) c.pressure = s.real("pressure_MPa", {1e-9, 1e6});
  c.mass = s.real("mass_g", c.mass * 1e6, {1e-6, 1e9}) * 1e-6;
  c.jaw_damping = s.real("damping_N_s_mm", 0, {0, 1e6});
  c.speed = s.real("speed_mm_s", c.speed, {1e-6, 1e6});
  c.hold = s.real("hold_s", 0, {0, 1e6});
  c.opens = s.flag("opens", false);
  c.angle = s.real("angle_deg", 0, {-20, 20}) * M_PI / 180;
  for (const char* key : {"speed_mm_s", "hold_s", "opens"})
    if (c.pressure && s.has(key)) throw Failure(ExitCode::misuse, "the jaw is driven by a pressure and by a motion", s.where(key), "leave one out");
  return c;
}

/// Ends: "section" holds what is at right angles to the local centre line, "fixed" everything, "free" nothing; rotations stay free. "slice" is cut out
/// of a longer tube: nothing moves or turns out of the plane of the end.
Holds read_ends(const Settings& s, const ShellMesh& mesh, const Wall& wall) {
  Holds holds = no_holds(wall);
  const std::string kind = s.has("ends") ? s.choice("ends", {"section", "fixed", "free", "slice"}) : "section";
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (mesh.end[i] == 0 || kind == "free") continue;
    holds.hold[i] = kind == "fixed" ? Hold::fixed : kind == "slice" ? Hold::across : Hold::along;
    holds.direction[i] = lanes(mesh.end_direction[i]);
  }
  if (kind == "slice")
    for (std::size_t e = 0; e < wall.edges.size(); ++e) holds.edge_fixed[e] = mesh.end[wall.edges[e][0]] != 0 && mesh.end[wall.edges[e][0]] == mesh.end[wall.edges[e][1]];
  return holds;
}

void read_steps(const Settings& settings, Case& c) {
  if (!settings.has("steps")) return;
  const Settings s = settings.table("steps");
  c.duration = s.real("duration_s", 0, {0, 1e6});
  c.safety = s.real("safety", c.safety, {0.05, 0.95});
  c.damping = s.real("damping_1_s", c.damping, {0, 1e9});
  c.least_step = s.real("least_step_s", 0, {0, 1});
  c.kinetic_part = s.real("kinetic_part", 0, {0, 1});
  c.rest_part = s.real("rest_part", 0, {0, 1});
  if (c.rest_part > 0 && (c.clamp.pressure || c.clamp.opens))
    throw Failure(ExitCode::misuse, "rest is sought where the jaws stop, and these go on", s.where("rest_part"), "leave it out, or let the jaws close by a motion and stay");
  c.settle = s.real("settle_s", 0, {0, 1e3});
  if (c.kinetic_part > 0 && c.clamp.pressure)
    throw Failure(ExitCode::misuse, "a jaw that a pressure drives does not wait", s.where("kinetic_part"), "leave it out, or [clamp] speed_mm_s instead of pressure_MPa");
  c.frames = static_cast<int>(s.integer("frames", c.frames, {1, 10000}));
  c.rows = static_cast<int>(s.integer("rows", c.rows, {10, 1000000}));
  c.works = static_cast<int>(s.integer("stress_works", 0, {0, 200}));
  c.keep_partial = s.flag("keep_partial", false);
}

/// Mass for the nodes of triangles that would need a smaller step: as much of each triangle's own as the step asks for.
void scale_mass(Wall& wall, double least_step) {
  if (!(least_step > 0)) return;
  const WallState rest = rest_state(wall);
  for (int t = 0; t < wall.triangles.size(); ++t) {
    const double ratio = least_step / stable_step(wall, rest, t);
    if (ratio <= 1) continue;
    const auto shape = lane(wall.packs[t / 4].rest, t % 4);
    wall.mass_factor[t] = ratio * ratio;
    const double third = wall.density * shape.thickness * shape.area / 3, extra = (ratio * ratio - 1) * third;
    for (int k = 0; k < 3; ++k) {
      wall.mass[wall.triangles[t][k]] += extra;
      wall.inertia[wall.triangle_edges[t][k]] += extra * std::max(shape.thickness * shape.thickness / 12, shape.area / 8);
      wall.added_mass += extra;
    }
  }
}

}  // namespace

Case read_case(const std::filesystem::path& path, const std::filesystem::path& mesh_override) {
  const Settings settings = Settings::read(path);
  if (settings.text("schema") != "palpate-case/1")
    throw Failure(ExitCode::misuse, "not a case this version reads", settings.where("schema"), "schema = \"palpate-case/1\"");
  settings.text("scheme");
  Case c;
  const std::string mesh = settings.text("mesh", "wall.vtu");
  c.mesh_path = mesh_override.empty() ? path.parent_path() / mesh : mesh_override;
  c.mesh = read_shells(c.mesh_path);
  const Settings material = settings.table("material");
  const ShellLaw law = read_law(material, c.law, c.tissue.material);
  const auto given = given_effects(settings);
  thicken(given, c.mesh);
  c.wall = make_wall(c.mesh, law, 1e-12 * material.real("density_kg_m3", 1050, {1e-3, 1e5}));
  c.holds = read_ends(settings, c.mesh, c.wall);
  const Settings clamp = settings.table("clamp");
  c.clamp = read_clamp(clamp, c.mesh);
  c.self_friction = clamp.real("self_friction", 0, {0, 10});
  read_steps(settings, c);
  for (const auto& one : given) c.law["effects"].push_back(one.active.effect.entry.name);
  add_effects(given, c);
  if (c.works > 0)
    for (const auto& one : given)
      if (const std::string& name = one.active.effect.entry.name; !one.active.effect.traction.respond && name != "thickness" && name != "prony")
        throw Failure(ExitCode::misuse, "stress_works is of the law's stresses alone, without " + name, one.table.where(), "leave the effect or [steps] stress_works out");
  scale_mass(c.wall, c.least_step);
  settings.expect_all_read();
  return c;
}

}  // namespace palpate::explicit_shell
