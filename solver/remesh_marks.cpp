// Marks on tetrahedra.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/remesh_marks.hpp>

#include <algorithm>

namespace palpate {
namespace {

using Eigen::Vector3d;
using implicit::Model;
using implicit::State;

Vector3d now(const Model& model, const State& state, int node) { return model.points[node] + state.displacement(node); }

template <std::size_t n>
double longest_edge(const Model& model, const State& state, const std::array<int, n>& corners) {
  double longest = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, (now(model, state, corners[i]) - now(model, state, corners[j])).norm());
  return longest;
}

/// What a tool asks of a face near it: the longest edge, mm.
double wish(const contact::Tool& tool, const contact::Pose& pose, const Vector3d& x, const RemeshRules& rules) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(tool.distance(x, pose).hessian, Eigen::EigenvaluesOnly);
  const double curvature = principal.eigenvalues().cwiseAbs().maxCoeff();
  return std::max(rules.finest_mm, rules.part_of_radius / std::max(curvature, 1e-12));
}

/// The tetrahedra of marked nodes take the smallest wish of their nodes.
std::vector<double> spread(const Model& model, const State& state, const std::vector<double>& of_node) {
  std::vector<double> marks(model.tets.size(), 0.0);
  bool any = false;
  for (std::size_t t = 0; t < model.tets.size(); ++t) {
    double least = 1e300;
    for (int node : model.tets[t])
      if (of_node[node] > 0) least = std::min(least, of_node[node]);
    if (!(least < longest_edge(model, state, model.tets[t]))) continue;
    marks[t] = least;
    any = true;
  }
  return any ? marks : std::vector<double>{};
}

}  // namespace

std::vector<double> contact_marks(const Model& model, const State& state, const implicit::ContactSums& contact, const RemeshRules& rules) {
  constexpr int points = contact::points_per_face;
  constexpr double near = 1;  // face sizes from a tool: about to be touched
  std::vector<double> of_node(model.points.size(), 0.0);
  bool too_coarse = false;
  for (std::size_t i = 0; i < model.tools.size() && !contact.points.empty(); ++i) {
    const auto pose = implicit::pose(model, state, static_cast<int>(i));
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
      const auto corners = implicit::corners_now(model, state, static_cast<int>(f));
      const Vector3d centre = (corners[0] + corners[1] + corners[2]) / 3;
      const double longest = longest_edge(model, state, model.faces[f]);
      if (!(model.tools[i].distance(centre, pose).g < near * longest)) continue;
      const double asked = wish(model.tools[i], pose, centre, rules);
      const auto first = contact.points.begin() + (i * model.faces.size() + f) * points;
      const bool touches = std::any_of(first, first + points, [](const contact::Point& p) { return p.pressure > 0; });
      too_coarse = too_coarse || (touches && longest > asked);
      for (int node : model.faces[f]) of_node[node] = of_node[node] > 0 ? std::min(of_node[node], asked) : asked;
    }
  }
  return too_coarse ? spread(model, state, of_node) : std::vector<double>{};
}

std::vector<double> trouble_marks(const Model& model, const State& state, const Vector3d& place_mm, const RemeshRules& rules) {
  int nearest = 0;
  for (int n = 0; n < static_cast<int>(model.points.size()); ++n)
    if ((model.points[n] - place_mm).norm() < (model.points[nearest] - place_mm).norm()) nearest = n;
  std::vector<double> of_node(model.points.size(), 0.0);
  for (const auto& tet : model.tets)
    if (std::count(tet.begin(), tet.end(), nearest))
      for (int node : tet) of_node[node] = std::max(rules.finest_mm / 2, longest_edge(model, state, tet) / 2);
  return spread(model, state, of_node);
}

double default_finest(const Model& model) {
  double sum = 0;
  for (const auto& f : model.faces)
    for (int k = 0; k < 3; ++k) sum += (model.points[f[k]] - model.points[f[(k + 1) % 3]]).norm();
  return sum / (3 * model.faces.size()) / 2;
}

}  // namespace palpate
