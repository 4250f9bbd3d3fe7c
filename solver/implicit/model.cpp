// Gathering an element's unknowns.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/slips.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace palpate::implicit {

State rest_state(const Model& model) {
  State state;
  state.nodal = Eigen::VectorXd::Zero(4 * model.points.size());
  state.bubbles.assign(model.tets.size(), Eigen::Vector3d::Zero());
  state.contact_pressures.assign(contact::points_per_face * model.faces.size() * model.tools.size(), 0.0);
  state.travels.assign(model.tools.size(), 0.0);
  std::size_t pair_points = 0;
  for (const auto& pass : model.passes) pair_points += contact::points_per_face * pass.own.size();
  state.pair_pressures.assign(pair_points, 0.0);
  std::size_t memory = memory_starts(model).back();
  for (const auto& bed : model.region_forces) memory += bed.memory() * bed.points.size();
  state.memory.assign(memory, 0.0);
  remember_slips(model, {}, state);
  return state;
}

bool has_friction(const Model& model) {
  return std::any_of(model.tools.begin(), model.tools.end(), [](const auto& tool) { return tool.holds_on(); });
}

bool organs_rub(const Model& model) {
  return std::any_of(model.passes.begin(), model.passes.end(), [](const auto& pass) { return pass.friction > 0; });
}

bool has_force_control(const Model& model) {
  return std::any_of(model.tools.begin(), model.tools.end(), [](const auto& tool) { return tool.force_controlled; });
}

bool remembers(const Model& model) {
  return std::any_of(model.materials.begin(), model.materials.end(), [](const auto& material) { return !material.effects.empty(); });
}

double grown_part(double time) { return std::clamp(1 + time, 0.0, 1.0); }

namespace {

/// A pressure that follows its faces has a potential when they close a surface, or when the edge of their patch is held. (Bufler 1984,
/// Z. angew. Math. Mech. 64:287.)
bool has_potential(const Model& model, const FacePressure& pressure, const std::map<int, int>& held_components) {
  std::set<std::pair<int, int>> edges;
  for (int f : pressure.faces)
    for (int k = 0; k < 3; ++k) edges.insert({model.faces[f][k], model.faces[f][(k + 1) % 3]});
  const auto held = [&](int node) { return held_components.contains(node) && held_components.at(node) == 7; };
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return edges.contains({edge.second, edge.first}) || (held(edge.first) && held(edge.second));
  });
}

}  // namespace

bool is_conservative(const Model& model) {
  if (has_friction(model) || !model.passes.empty()) return false;
  for (const auto& bed : model.region_forces)
    if (!bed.effect.force.symmetric(bed.parameters)) return false;
  for (const auto& tool : model.tools)  // what reaches out acts on the area that the tool sees
    if (std::any_of(tool.tractions.begin(), tool.tractions.end(), [](const auto& active) { return active.effect.traction.reach != nullptr; })) return false;
  std::map<int, int> held;  // components of each node, one bit each
  for (const auto& p : model.prescribed)
    if (p.component < 3) held[p.node] |= 1 << p.component;
  return std::all_of(model.pressures.begin(), model.pressures.end(), [&](const auto& pressure) { return has_potential(model, pressure, held); });
}

contact::Pose pose(const Model& model, const State& state, int tool) {
  const auto& t = model.tools[tool];
  return {t.force_controlled ? state.travels[tool] : t.travel(state.time), t.turn.at(state.time)};
}

std::vector<int> tets_of_faces(const Model& model) {
  std::map<std::array<int, 3>, int> tet_of;
  for (int t = 0; t < static_cast<int>(model.tets.size()); ++t)
    for (int s = 0; s < 4; ++s) {
      std::array<int, 3> face;
      for (int a = 0, i = 0; a < 4; ++a)
        if (a != s) face[i++] = model.tets[t][a];
      std::sort(face.begin(), face.end());
      tet_of[face] = t;
    }
  std::vector<int> tets;
  for (auto face : model.faces) {
    std::sort(face.begin(), face.end());
    tets.push_back(tet_of.at(face));
  }
  return tets;
}

std::vector<double> softness_of_faces(const Model& model) {
  constexpr double over_shear_modulus = 2;  // a pressure of 2 μ takes half of the penetration that is allowed
  std::vector<double> softness;
  for (int t : tets_of_faces(model)) softness.push_back(over_shear_modulus * model.materials[model.tet_material[t]].shear_modulus());
  return softness;
}

std::vector<std::vector<int>> nodes_around(const Model& model) {
  std::vector<std::vector<int>> around(model.points.size());
  for (const auto& face : model.faces)
    for (int node : face) around[node].insert(around[node].end(), face.begin(), face.end());
  for (auto& nodes : around) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return around;
}

std::array<Eigen::Vector3d, 3> corners_at(const Model& model, const Eigen::VectorXd& nodal, int face) {
  std::array<Eigen::Vector3d, 3> corners;
  for (int a = 0; a < 3; ++a) corners[a] = model.points[model.faces[face][a]] + nodal.segment<3>(4 * model.faces[face][a]);
  return corners;
}

std::array<Eigen::Vector3d, 3> corners_now(const Model& model, const State& state, int face) { return corners_at(model, state.nodal, face); }

std::array<Eigen::Vector3d, 3> corners_at_rest(const Model& model, int face) {
  return {model.points[model.faces[face][0]], model.points[model.faces[face][1]], model.points[model.faces[face][2]]};
}

std::vector<contact::Triangle> faces_now(const Model& model, const State& state) {
  std::vector<contact::Triangle> list;
  for (int f = 0; f < static_cast<int>(model.faces.size()); ++f) list.push_back(corners_now(model, state, f));
  return list;
}

std::vector<contact::Triangle> faces_at_rest(const Model& model) {
  std::vector<contact::Triangle> list;
  for (int f = 0; f < static_cast<int>(model.faces.size()); ++f) list.push_back(corners_at_rest(model, f));
  return list;
}

std::vector<int> memory_starts(const Model& model) {
  std::vector<int> starts{0};
  for (int material : model.tet_material) starts.push_back(starts.back() + 4 * model.materials[material].memory());
  return starts;
}

elements::ElementState element_state(const Model& model, const State& state, int tet, int memory_start) {
  elements::ElementState local;
  for (int a = 0; a < 4; ++a) local.nodal.segment<4>(4 * a) = state.nodal.segment<4>(4 * model.tets[tet][a]);
  local.bubble = state.bubbles[tet];
  if (!model.starts.empty()) local.starts = model.starts[tet].data();
  local.history = {state.memory.data() + memory_start, state.time, state.time - state.memory_time};
  return local;
}

Eigen::Matrix<double, 3, 4> corners(const Model& model, const std::array<int, 4>& tet) {
  Eigen::Matrix<double, 3, 4> X;
  for (int a = 0; a < 4; ++a) X.col(a) = model.points[tet[a]];
  return X;
}

Eigen::Vector3d centroid(const Model& model, int tet) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int node : model.tets[tet]) sum += model.points[node];
  return sum / 4;
}

}  // namespace palpate::implicit
