// Reading what holds, loads and presses: [base], [[displacement]], [[force]], [[pressure]], [[spring]],
// [gravity], [[tool]].
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/case_parts.hpp>

#include <cmath>
#include <map>

#include <palpate/errors.hpp>
#include <solver/selection.hpp>

namespace palpate {
namespace {

using Eigen::Vector3d;

CatalogueEntry gravity_entry() {
  return {"load", "gravity", "weight of the tissue, grown before the tools come: [gravity] direction, steps", "",
          {{"acceleration_m_s2", "m/s^2", {0, 1e3}, 9.81, "times density_kg_m3 of the material"}}};
}
CatalogueEntry pressure_entry() {
  return {"load", "pressure", "a pressure on a patch of surface that stays at right angles to it: [[pressure]] patch, path", "Bufler 1984, Z. angew. Math. Mech. 64:287",
          {{"pressure_MPa", "MPa", {-1e3, 1e3}, 0.001, "towards the organ"}}};
}
CatalogueEntry spring_entry() {
  return {"load", "spring", "pulls a patch of surface back to rest, the same in all directions: [[spring]] patch", "",
          {{"stiffness_N_mm3", "N/mm^3", {0, 1e6}, 0.01, "force per area and mm"}}};
}

double number(const Settings& table, const CatalogueEntry& entry) { return parameters(entry, table).front(); }

/// path = [[t_s, value], …] with ascending times, divided by its largest value; or a ramp from 0 to `duration`.
Amplitude read_path(const Settings& settings, double duration, double& largest) {
  if (!settings.has("path")) return {{{0, 0}, {duration, 1}}};
  const Json path = settings.value("path");
  Amplitude amplitude;
  const auto wrong = [&](const std::string& what) {
    throw Failure(ExitCode::misuse, what, settings.where("path"), "path = [[0, 0], [2, 6.0], [5, 6.0]]: times in s, ascending, and values");
  };
  if (!path.is_array() || path.size() < 2) wrong("a path is a list of at least two points");
  largest = 0;
  for (const auto& point : path) {
    if (!point.is_array() || point.size() != 2 || !point[0].is_number() || !point[1].is_number()) wrong("a point of a path is a time and a value");
    amplitude.points.push_back({point[0].get<double>(), point[1].get<double>()});
    if (!std::isfinite(amplitude.points.back()[0]) || !std::isfinite(amplitude.points.back()[1])) wrong("a path holds a number that is not finite");
    if (amplitude.points.front()[0] < 0) wrong("a path begins before t = 0");
    if (amplitude.points.size() > 1 && !(amplitude.points.back()[0] > amplitude.points[amplitude.points.size() - 2][0])) wrong("times do not ascend");
    largest = std::max(largest, std::abs(amplitude.points.back()[1]));
  }
  if (!(largest > 0)) wrong("a path goes nowhere");
  for (auto& point : amplitude.points) point[1] /= largest;
  return amplitude;
}

/// Rest area of the surface around each node, mm².
std::map<int, double> nodal_areas(const Case& c) {
  std::map<int, double> areas;
  for (const auto& f : c.model.faces) {
    const auto& x = c.model.points;
    const double third = (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]).norm() / 6;
    for (int node : f) areas[node] += third;
  }
  return areas;
}

int add_amplitude(implicit::Model& model, Amplitude amplitude) {
  model.amplitudes.push_back(std::move(amplitude));
  return static_cast<int>(model.amplitudes.size()) - 1;
}

void read_base(const Settings& settings, Case& c, std::set<int>& held) {
  if (settings.has("base")) held = chosen_nodes(settings.table("base"), c.mesh);
  else if (!settings.has("spring") && !settings.has("displacement") && !settings.has("symmetry") && c.model.region_forces.empty())
    throw Failure(ExitCode::misuse, "nothing holds the organ", settings.where(), "[base], [[spring]], [[displacement]], [[symmetry]] or an effect such as support");
  c.base = held;
  for (int node : held)
    for (int component = 0; component < 3; ++component) c.model.prescribed.push_back({node, component, 0});
}

void read_displacements(const Settings& settings, Case& c, std::set<int>& held) {
  for (const auto& table : settings.tables("displacement")) {
    Vector3d motion = eigen(table.vec3("motion_mm"));
    double factor = 1;
    const int ramp = add_amplitude(c.model, read_path(table, table.real("duration_s", 1, {1e-6, 1e6}), factor));
    motion *= factor;
    Moved moved{chosen_nodes(table, c.mesh), motion, ramp};
    for (int node : moved.nodes) {
      if (!held.insert(node).second)
        throw Failure(ExitCode::misuse, "a node is moved that is held or moved already, at " + text_mm(c.model.points[node]), table.where());
      for (int component = 0; component < 3; ++component) c.model.prescribed.push_back({node, component, motion(component), ramp});
    }
    c.moved.push_back(std::move(moved));
  }
}

/// The axis a plane of symmetry is at right angles to: 0, 1 or 2. Failure(misuse) when there is none.
int axis_of_symmetry(const Settings& plane) {
  const Vector3d normal = direction(plane, "normal");
  int axis = 0;
  if (normal.cwiseAbs().maxCoeff(&axis) < 1 - 1e-12)
    throw Failure(ExitCode::misuse, "a plane of symmetry is at right angles to x, y or z", plane.where("normal"), "turn the mesh so that it is");
  return axis;
}

/// Nodes on a plane of symmetry stay on it; what else holds or moves them must not pull them off.
void read_symmetries(const Settings& settings, Case& c, const std::set<int>& held) {
  constexpr double part_of_size = 1e-6;  // nodes so near to the plane are on it
  Eigen::AlignedBox3d box;
  for (const auto& x : c.mesh.points) box.extend(eigen(x));
  const double near = part_of_size * box.diagonal().norm();
  std::set<std::pair<int, int>> kept;
  for (const auto& table : settings.tables("symmetry")) {
    const Settings plane = table.table("plane");
    const int axis = axis_of_symmetry(plane);
    const double place = plane.vec3("point_mm")[axis], side = direction(plane, "normal")(axis);
    const auto off = [&](int node) { return side * (c.mesh.points[node][axis] - place); };
    Symmetry symmetry{{}, axis};
    for (int node : boundary_nodes(c.mesh)) {
      if (off(node) < -near)
        throw Failure(ExitCode::misuse, "the organ goes through its plane of symmetry, at " + text_mm(c.model.points[node]), table.where(), "cut it there, or turn the normal towards it");
      if (off(node) > near) continue;
      symmetry.nodes.insert(node);
      if (!held.contains(node) && kept.insert({node, axis}).second) c.model.prescribed.push_back({node, axis, 0});
    }
    if (symmetry.nodes.size() < 3)
      throw Failure(ExitCode::misuse, std::to_string(symmetry.nodes.size()) + " nodes of the surface are on the plane of symmetry", table.where(), "at least three");
    for (const auto& moved : c.moved)
      for (int node : moved.nodes)
        if (off(node) <= near && moved.motion_mm(axis) != 0)
          throw Failure(ExitCode::misuse, "a displacement moves a node off the plane of symmetry, at " + text_mm(c.model.points[node]), table.where());
    c.symmetries.push_back(std::move(symmetry));
  }
}

/// What is given for a patch of surface is shared among its nodes by their areas.
void read_forces_and_springs(const Settings& settings, Case& c) {
  const auto areas = nodal_areas(c);
  for (const auto& table : settings.tables("force")) {
    const Vector3d total = eigen(table.vec3("total_N"));
    double factor = 1, area = 0;
    const int ramp = add_amplitude(c.model, read_path(table, table.real("duration_s", 1, {1e-6, 1e6}), factor));
    const auto nodes = chosen_nodes(table, c.mesh);
    for (int node : nodes) area += areas.at(node);
    for (int node : nodes) c.model.nodal_forces.push_back({node, factor * areas.at(node) / area * total, ramp});
  }
  for (const auto& table : settings.tables("pressure")) {
    implicit::FacePressure pressure{chosen_faces(table, c.mesh), 0, 0};
    double factor = 1;
    if (!table.has("path")) factor = number(table, pressure_entry());
    pressure.amplitude = add_amplitude(c.model, read_path(table, table.real("duration_s", 1, {1e-6, 1e6}), factor));
    pressure.value = factor;
    c.model.pressures.push_back(std::move(pressure));
  }
  for (const auto& table : settings.tables("spring")) {
    const double stiffness = number(table, spring_entry());
    for (int node : chosen_nodes(table, c.mesh)) c.model.springs.push_back({node, stiffness * areas.at(node)});
  }
}

/// turn = { about = [..], from_tip_mm = [..], path = [[t, degrees], …] }
void read_turn(const Settings& settings, contact::Tool& tool) {
  double largest = 0;
  tool.spin = direction(settings, "about");
  tool.pivot = eigen(settings.vec3("from_tip_mm", {0, 0, 0}));
  tool.turn = read_path(settings, 1, largest);
  if (tool.turn.points.front() != std::array<double, 2>{0, 0})
    throw Failure(ExitCode::misuse, "a turn begins at 0 degrees", settings.where("path"), "path = [[0, 0], [2, 30.0]]");
  for (auto& point : tool.turn.points) point[1] *= largest * M_PI / 180;
}

contact::Tool read_tool(const Settings& settings, Case& c, Vector3d& aim) {
  contact::Tool tool;
  tool.shape = named(tools::all(), settings, "kind");
  if (tool.shape.read) {
    c.tool_files.push_back(settings.file().parent_path() / settings.text("file"));
    tool.shape.distance = tool.shape.read(c.tool_files.back());
  }
  tool.parameters = parameters(tool.shape.entry, settings);
  tool.axis = direction(settings, "axis");
  if (settings.has("across")) tool.across = direction(settings, "across");
  if (settings.has("across") && !(tool.across.cross(tool.axis).norm() > 1e-3))
    throw Failure(ExitCode::misuse, "across points along the tool's axis", settings.where("across"), "a direction at right angles to axis");
  const double speed = settings.real("speed_mm_s", 1.0, {1e-6, 1e6});
  tool.force_controlled = settings.has("control") && settings.choice("control", {"depth", "force"}) == "force";
  double& largest = tool.force_controlled ? tool.force : tool.depth;
  if (!settings.has("path")) largest = tool.force_controlled ? settings.real("force_N", {1e-9, 1e6}) : settings.real("depth_mm", {1e-6, 1e3});
  tool.ramp = read_path(settings, tool.force_controlled ? settings.real("duration_s", 1, {1e-6, 1e6}) : tool.depth / speed, largest);
  if (settings.has("turn")) read_turn(settings.table("turn"), tool);
  const double friction = coulombs_coefficient(settings);
  if (friction > 0) tool.tractions.push_back({effects::friction(), {friction}});
  for (const auto& given : c.effects)
    if (given.effect.traction.respond && given.parameters[0] != 0 && (given.tool == 0 || given.tool == static_cast<int>(c.model.tools.size()) + 1))
      tool.tractions.push_back(given);
  aim = eigen(settings.vec3("aim_mm"));
  if (contact::find_first_contact(tool, aim, surface_triangles(c, nullptr))) return tool;
  Eigen::AlignedBox3d box;
  for (int node : boundary_nodes(c.mesh)) box.extend(c.model.points[node]);
  throw Failure(ExitCode::misuse, "the tool misses the organ: its line through " + text_mm(aim) + " does not meet it", settings.where("aim_mm"),
                "aim inside the organ's box, " + text_mm(box.min()) + " to " + text_mm(box.max()));
}

}  // namespace

std::vector<std::array<Vector3d, 3>> surface_triangles(const Case& c, const implicit::State* state) {
  std::vector<std::array<Vector3d, 3>> triangles;
  for (const auto& face : c.model.faces) {
    auto& corners = triangles.emplace_back();
    for (int a = 0; a < 3; ++a) corners[a] = c.model.points[face[a]] + (state ? state->displacement(face[a]) : Vector3d::Zero());
  }
  return triangles;
}

std::vector<CatalogueEntry> load_entries() {
  return {gravity_entry(), pressure_entry(), spring_entry()};
}

void plan_settling(Case& c, int steps) {
  c.settling.times.clear();
  for (int i = 0; i <= steps; ++i) c.settling.times.push_back(-1 + double(i) / steps);
  c.settling.times.back() = 0;
}

void read_loads(const Settings& settings, Case& c) {
  std::set<int> held;
  read_base(settings, c, held);
  read_displacements(settings, c, held);
  read_symmetries(settings, c, held);
  read_forces_and_springs(settings, c);
  if (!settings.has("gravity")) return;
  const Settings gravity = settings.table("gravity");
  const Parameter weight = gravity_entry().parameters.front();
  c.model.gravity = gravity.real("acceleration_m_s2", weight.typical, weight.range) * direction(gravity, "direction");
  plan_settling(c, static_cast<int>(gravity.integer("steps", 4, {1, 1000})));
  c.model.body_amplitude = add_amplitude(c.model, {{{-1, 0}, {0, 1}}});
}

void read_tools(const Settings& settings, Case& c) {
  for (const auto& table : settings.tables("tool")) {
    c.aims_mm.emplace_back();
    c.model.tools.push_back(read_tool(table, c, c.aims_mm.back()));
  }
}

void take_tools_away(Case& c) {
  constexpr double away_mm = 1e6;
  for (auto& tool : c.model.tools) tool.first_contact -= away_mm * tool.axis;
}

void bring_tools(Case& c, const implicit::State& state) {
  const auto surface = surface_triangles(c, &state);
  for (std::size_t i = 0; i < c.model.tools.size(); ++i)
    if (!contact::find_first_contact(c.model.tools[i], c.aims_mm[i], surface))
      throw Failure(ExitCode::misuse, "under gravity the organ has sagged out of the tool's way", "", "aim lower");
}

double end_of_loads(const implicit::Model& model) {
  double end = 0;
  const auto consider = [&](const Amplitude& a) {
    if (!a.points.empty()) end = std::max(end, a.points.back()[0]);
  };
  for (const auto& tool : model.tools) {
    consider(tool.ramp);
    if (tool.turns()) consider(tool.turn);
  }
  for (const auto& amplitude : model.amplitudes) consider(amplitude);
  return end;
}

}  // namespace palpate
