// Marks on tetrahedra.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/remesh_marks.hpp>

#include <algorithm>
#include <cmath>

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

/// Faces that a tool touches against its curvature; also about them, if one of them is too coarse. Empty: none is.
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

/// Half the longest edge of elements that have lost their shape. Empty: none has, or they are at their finest.
std::vector<double> shape_marks(const Model& model, const State& state, const RemeshRules& rules) {
  std::vector<double> marks(model.tets.size(), 0.0);
  const auto shape = shapes(model, state);
  bool any = false;
  for (std::size_t t = 0; t < marks.size(); ++t) {
    const double longest = longest_edge(model, state, model.tets[t]);
    if (shape[t] >= rules.least_shape || !(longest > rules.finest_mm)) continue;
    marks[t] = std::max(rules.finest_mm, longest / 2);
    any = true;
  }
  return any ? marks : std::vector<double>{};
}

}  // namespace

double mean_ratio(const Eigen::Matrix<double, 3, 4>& x) {
  double squares = 0;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < a; ++b) squares += (x.col(a) - x.col(b)).squaredNorm();
  const double six_volumes = (x.col(1) - x.col(0)).dot((x.col(2) - x.col(0)).cross(x.col(3) - x.col(0)));
  return std::copysign(12 * std::cbrt(six_volumes * six_volumes / 4) / squares, six_volumes);
}

std::vector<double> shapes(const Model& model, const State& state) {
  std::vector<double> shape;
  for (const auto& tet : model.tets) {
    const Eigen::Matrix<double, 3, 4> X = implicit::corners(model, tet);
    Eigen::Matrix<double, 3, 4> x = X;
    for (int a = 0; a < 4; ++a) x.col(a) += state.displacement(tet[a]);
    shape.push_back(mean_ratio(x) / mean_ratio(X));
  }
  return shape;
}

Marks marks(const Model& model, const State& state, const implicit::ContactSums& contact, const RemeshRules& rules) {
  auto asked = contact_marks(model, state, contact, rules);
  const auto of_shape = shape_marks(model, state, rules);
  std::string why = asked.empty() ? "" : "faces under a tool were too coarse";
  if (of_shape.empty()) return {std::move(asked), why};
  asked.resize(of_shape.size(), 0.0);
  for (std::size_t t = 0; t < asked.size(); ++t)
    if (of_shape[t] > 0) asked[t] = asked[t] > 0 ? std::min(asked[t], of_shape[t]) : of_shape[t];
  return {std::move(asked), why + (why.empty() ? "" : ", and ") + "elements had lost their shape"};
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
