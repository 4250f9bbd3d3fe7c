// Which socket an effect fits says where it goes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/explicit/case_effects.hpp>

#include <numeric>
#include <sstream>

#include <palpate/errors.hpp>
#include <solver/case_parts.hpp>
#include <solver/selection.hpp>

namespace palpate::explicit_shell {
namespace {

using Eigen::Vector3d;

constexpr double probing_stretch = 1.2;  ///< a state in which an effect's stiffness is asked
constexpr double most_stiffening = 100;  ///< ten times shorter steps

/// The wall's triangles as the faces that plane, box and label choose from.
TetMesh as_faces(const ShellMesh& mesh) {
  TetMesh faces;
  faces.points = mesh.points;
  faces.faces = mesh.triangles;
  faces.face_region = mesh.triangle_region;
  faces.region_names = mesh.region_names;
  return faces;
}

/// All of them where the table names none.
std::vector<int> chosen_triangles(const Settings& table, const ShellMesh& mesh) {
  if (table.has("plane") || table.has("box") || table.has("label")) return chosen_faces(table, as_faces(mesh));
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

Vector3d centre(const ShellMesh& mesh, int t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return eigen((1.0 / 3) * (mesh.points[a] + mesh.points[b] + mesh.points[c]));
}

void begin_tissue(const GivenEffect& given, Case& c) {
  auto& starts = c.tissue.starts;
  starts.resize(c.wall.triangles.size());
  bool counts = given.active.parameters[0] == 0;
  for (int t : chosen_triangles(given.table, c.mesh)) {
    const effects::Start before = starts[t];
    given.active.effect.start.begin(centre(c.mesh, t), given.active.parameters, starts[t]);
    counts = counts || starts[t].modulus != before.modulus || starts[t].turgor != before.turgor;
  }
  if (!counts) throw Failure(ExitCode::misuse, given.active.effect.entry.name + " changes nothing: it lies outside of the wall, or between its points", given.table.where(), "another place, or a finer mesh there");
}

void lay(const GivenEffect& given, Case& c) {
  WallLayer layer{given.active, 0, std::vector<char>(c.wall.triangles.size(), 0)};
  const std::string face = given.table.has("face") ? given.table.choice("face", {"inner", "middle", "outer"}) : "middle";
  layer.place = face == "inner" ? -1 : face == "outer" ? 1 : 0;
  for (int t : chosen_triangles(given.table, c.mesh)) layer.on[t] = 1;
  c.tissue.layers.push_back(std::move(layer));
}

/// How many times stiffer the effects on the stress make the law within one step from a stretched state.
double stiffer(const elements::Material& material, double step) {
  const materials::Mat3 F = Vector3d(probing_stretch, 1, 1 / probing_stretch).asDiagonal();
  const effects::Point point{F, step, step, material.law.kinematics};
  std::vector<double> memory(material.memory(), 0);
  material.remember(point, memory.data());
  return material.respond(point, memory.data()).A.operatorNorm() / material.respond(F).A.operatorNorm();
}

void expect_bearable(const Settings& where, const Case& c, double step) {
  const double times = stiffer(c.tissue.material, step);
  if (!(times > most_stiffening)) return;
  std::ostringstream what;
  what << "this effect resists motion " << times << " times as much as the law within a step of " << step << " s: steps would have to be " << std::sqrt(times) << " times shorter";
  throw Failure(ExitCode::misuse, what.str(), where.where(), "leave it out, or scheme = \"implicit\" on a solid mesh");
}

}  // namespace

std::vector<GivenEffect> given_effects(const Settings& settings) {
  std::vector<GivenEffect> list;
  for (const auto& table : settings.tables("effect")) list.push_back({table, read_effect(table)});
  return list;
}

void thicken(const std::vector<GivenEffect>& given, ShellMesh& mesh) {
  for (const auto& [table, active] : given) {
    if (!active.effect.start.thickness) continue;
    bool counts = active.parameters[0] == 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const double factor = active.effect.start.thickness(eigen(mesh.points[i]), active.parameters);
      counts = counts || factor != 1;
      mesh.thickness_mm[i] *= factor;
    }
    if (!counts) throw Failure(ExitCode::misuse, active.effect.entry.name + " changes nothing: it lies outside of the wall", table.where(), "another place, or a wider zone");
  }
}

void add_effects(const std::vector<GivenEffect>& given, Case& c) {
  const WallState rest = rest_state(c.wall);
  double step = std::numeric_limits<double>::infinity();
  for (int t = 0; t < c.wall.triangles.size(); ++t) step = std::min(step, stable_step(c.wall, rest, t));
  for (const auto& one : given) {
    const auto& [table, active] = one;
    const auto& effect = active.effect;
    if ((effect.stress.respond || effect.start.begin) && std::visit([](const auto& law) { return law.poisson(); }, c.wall.law) < 0.5)
      throw Failure(ExitCode::misuse, effect.entry.name + " on a thin wall needs a law that keeps its volume", table.where(), "nu = 0.5, or another law");
    if (effect.stress.respond) c.tissue.material.add(effect, active.parameters), expect_bearable(table, c, step);
    if (effect.start.begin) begin_tissue(one, c);
    if (effect.layer.respond) lay(one, c);
    if (effect.force.respond) c.beds.push_back(make_bed(active, c.wall, chosen_faces(table, as_faces(c.mesh))));
    if (effect.traction.respond) {
      table.integer("tool", 1, {1, 1});
      c.clamp.tractions.push_back(active);
    }
  }
  if (c.tissue.plain()) return;
  c.wall.stiffening = stiffening(c.tissue, c.wall);
  const double times = c.tissue.material.effects.empty() ? 1 : std::max(1.0, stiffer(c.tissue.material, step));
  for (double& factor : c.wall.stiffening) factor *= times;
}

}  // namespace palpate::explicit_shell
