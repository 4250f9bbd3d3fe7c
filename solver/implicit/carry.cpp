// Carrying over, from nodes, points of faces and sub-tetrahedra.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/carry.hpp>

#include <algorithm>

#include <solver/implicit/slips.hpp>

namespace palpate::implicit {
namespace {

using Eigen::Vector3d;

/// Which of a face's points lies nearest to `x`, in the face's own weights.
int nearest_point(const std::array<Vector3d, 3>& corners, const Vector3d& x) {
  Eigen::Matrix<double, 3, 2> edges;
  edges << corners[1] - corners[0], corners[2] - corners[0];
  const Eigen::Vector2d w = (edges.transpose() * edges).ldlt().solve(edges.transpose() * (x - corners[0]));
  int nearest = 0;
  double least = 1e300;
  for (int q = 0; q < contact::points_per_face; ++q) {
    const auto& N = contact::quadrature[q].N;
    const double away = std::pow(w(0) - N[1], 2) + std::pow(w(1) - N[2], 2) + std::pow(w(0) + w(1) - N[1] - N[2], 2);
    if (away < least) {
      least = away;
      nearest = q;
    }
  }
  return nearest;
}

/// The old face's points that the six points of a new face take their values from.
std::array<int, contact::points_per_face> sources(const Model& old_model, const Model& model, int face, int parent) {
  std::array<int, contact::points_per_face> list{};
  const auto own = corners_at_rest(model, face), whole = corners_at_rest(old_model, parent);
  for (int q = 0; q < contact::points_per_face; ++q) {
    const auto& N = contact::quadrature[q].N;
    list[q] = nearest_point(whole, N[0] * own[0] + N[1] * own[1] + N[2] * own[2]);
  }
  return list;
}

/// The sub-tetrahedron of a tetrahedron that holds x: opposite to the corner with the smallest weight.
int sub_of(const Model& model, const std::array<int, 4>& tet, const Vector3d& x) {
  Eigen::Matrix4d corners;
  for (int a = 0; a < 4; ++a) corners.col(a) << model.points[tet[a]], 1;
  int smallest = 0;
  corners.partialPivLu().solve(Eigen::Vector4d(x.x(), x.y(), x.z(), 1)).minCoeff(&smallest);
  return smallest;
}

void carry_memory(const Model& old_model, const State& old_state, const Model& model, const Origins& origins, State& state) {
  const auto old_starts = memory_starts(old_model), starts = memory_starts(model);
  if (starts.back() == 0) return;
  for (int t = 0; t < static_cast<int>(model.tets.size()); ++t) {
    const int parent = origins.tets[t], size = (starts[t + 1] - starts[t]) / 4;
    Vector3d sum = Vector3d::Zero();
    for (int node : model.tets[t]) sum += model.points[node];
    for (int s = 0; s < 4; ++s) {
      const Vector3d centroid = (sum - model.points[model.tets[t][s]] + sum / 4) / 4;
      const double* from = old_state.memory.data() + old_starts[parent] + sub_of(old_model, old_model.tets[parent], centroid) * size;
      std::copy(from, from + size, state.memory.data() + starts[t] + s * size);
    }
  }
}

/// What beds on the surface remember (slip): by the weights, of the old nodes that the bed had.
void carry_beds(const Model& old_model, const State& old_state, const Model& model, const Origins& origins, State& state) {
  std::size_t old_first = memory_starts(old_model).back(), first = memory_starts(model).back();
  for (std::size_t b = 0; b < model.region_forces.size(); ++b) {
    const auto &bed = model.region_forces[b], &old_bed = old_model.region_forces[b];
    const int size = bed.memory();
    std::vector<const double*> memory_of(old_model.points.size(), nullptr);
    for (std::size_t i = 0; i < old_bed.points.size(); ++i) memory_of[old_bed.points[i].node] = old_state.memory.data() + old_first + i * size;
    for (std::size_t i = 0; i < bed.points.size(); ++i) {
      const int node = bed.points[i].node;
      double whole = 0;
      for (int k = 0; k < 4; ++k)
        if (memory_of[origins.nodes[node][k]]) whole += origins.weights[node][k];
      for (int k = 0; k < 4 && whole > 0; ++k)
        if (const double* from = memory_of[origins.nodes[node][k]])
          for (int j = 0; j < size; ++j) state.memory[first + i * size + j] += origins.weights[node][k] / whole * from[j];
    }
    old_first += old_bed.points.size() * size;
    first += bed.points.size() * size;
  }
}

void carry_contact(const Model& old_model, const State& old_state, const Model& model, const Origins& origins, State& state) {
  constexpr int points = contact::points_per_face;
  const std::size_t faces = model.faces.size(), old_faces = old_model.faces.size();
  std::vector<std::array<int, points>> from(faces);
  for (std::size_t f = 0; f < faces; ++f)
    if (origins.faces[f] >= 0) from[f] = sources(old_model, model, static_cast<int>(f), origins.faces[f]);
  for (std::size_t i = 0; i < model.tools.size(); ++i)
    for (std::size_t f = 0; f < faces; ++f)
      for (int q = 0; q < points && origins.faces[f] >= 0; ++q) {
        const std::size_t to = (i * faces + f) * points + q, at = (i * old_faces + origins.faces[f]) * points + from[f][q];
        state.contact_pressures[to] = old_state.contact_pressures[at];
        if (state.slips.empty()) continue;
        const auto& slip = old_state.slips[at];
        state.slips[to].place -= slip.place - slip.place_before;
        state.slips[to].shear = slip.shear_before;
      }
  std::vector<contact::PairSlip> slips(state.pair_slips.size());
  std::size_t first = 0, old_first = 0;
  for (std::size_t p = 0; p < model.passes.size(); ++p) {
    const auto &own = model.passes[p].own, &old_own = old_model.passes[p].own;
    std::vector<int> place(old_faces, -1);
    for (std::size_t i = 0; i < old_own.size(); ++i) place[old_own[i]] = static_cast<int>(i);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const int parent = origins.faces[own[i]];
      for (int q = 0; q < points && parent >= 0 && place[parent] >= 0; ++q) {
        const std::size_t to = first + i * points + q, at = old_first + place[parent] * points + from[own[i]][q];
        state.pair_pressures[to] = old_state.pair_pressures[at];
        if (!slips.empty()) slips[to] = old_state.pair_slips[at];
      }
    }
    first += own.size() * points;
    old_first += old_own.size() * points;
  }
  if (!slips.empty()) anchor_again(model, slips, state);
}

}  // namespace

State carried(const Model& old_model, const State& old_state, const Model& model, const Origins& origins) {
  State state = rest_state(model);
  state.time = old_state.time;
  state.memory_time = old_state.memory_time;
  state.travels = old_state.travels;
  for (std::size_t n = 0; n < model.points.size(); ++n)
    for (int i = 0; i < 4; ++i) state.nodal.segment<4>(4 * n) += origins.weights[n][i] * old_state.nodal.segment<4>(4 * origins.nodes[n][i]);
  remember_slips(model, {}, state);  // places: where the points are now
  carry_contact(old_model, old_state, model, origins, state);
  carry_memory(old_model, old_state, model, origins, state);
  carry_beds(old_model, old_state, model, origins, state);
  return state;
}

double volume(const Model& model, const State& state) {
  double sum = 0;
  for (const auto& tet : model.tets) {
    std::array<Vector3d, 4> x;
    for (int a = 0; a < 4; ++a) x[a] = model.points[tet[a]] + state.displacement(tet[a]);
    sum += (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0])) / 6;
  }
  return sum;
}

}  // namespace palpate::implicit
