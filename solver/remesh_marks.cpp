// Marks on tetrahedra.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/remesh_marks.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// What a tool touches.
struct Touched {
  double half_width = 0;          ///< mm: of an ellipse the smaller half-axis, by the second moments of the area around its centre
  std::vector<Vector3d> places;   ///< the touched points, mm
};

Touched touched(const Model& model, const State& state, const contact::Point* points) {
  constexpr int per_face = contact::points_per_face;
  Touched all;
  double area = 0;
  Vector3d first = Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const auto c = implicit::corners_now(model, state, static_cast<int>(f));
    const double whole = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
    for (int q = 0; q < per_face; ++q) {
      if (!(points[per_face * f + q].pressure > 0)) continue;
      const auto& [N, weight] = contact::quadrature[q];
      all.places.push_back(N[0] * c[0] + N[1] * c[1] + N[2] * c[2]);
      area += weight * whole;
      first += weight * whole * all.places.back();
      second += weight * whole * all.places.back() * all.places.back().transpose();
    }
  }
  if (!(area > 0)) return all;
  const Eigen::Matrix3d around = second / area - first * first.transpose() / (area * area);
  all.half_width = 2 * std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(around, Eigen::EigenvaluesOnly).eigenvalues()(1)));
  return all;
}

/// A contact's strains vary over its width, farther away over the distance from it: a wish for every tetrahedron, to its nearest corner, that a contact
/// which grows into it asks again.
std::vector<double> width_wishes(const Model& model, const State& state, const Touched& touched, const RemeshRules& rules) {
  std::vector<double> of_node(model.points.size(), std::numeric_limits<double>::infinity()), wishes;
  for (std::size_t n = 0; n < of_node.size(); ++n)
    for (const auto& place : touched.places) of_node[n] = std::min(of_node[n], (now(model, state, static_cast<int>(n)) - place).norm());
  for (const auto& tet : model.tets) {
    double distance = std::numeric_limits<double>::infinity();
    for (int node : tet) distance = std::min(distance, of_node[node]);
    wishes.push_back(std::max(rules.finest_mm, rules.part_of_contact * (touched.half_width + distance)));
  }
  return wishes;
}

/// What a tool asks of a face near it by its shape there: the longest edge, mm.
double wish(const contact::Tool& tool, const contact::Pose& pose, const Vector3d& x, const RemeshRules& rules) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(tool.distance(x, pose).hessian, Eigen::EigenvaluesOnly);
  const double curvature = principal.eigenvalues().cwiseAbs().maxCoeff();
  return std::max(rules.finest_mm, rules.part_of_radius / std::max(curvature, 1e-12));
}

/// The tetrahedra of marked nodes take the smallest wish of their nodes; 0: none.
std::vector<double> spread(const Model& model, const std::vector<double>& of_node) {
  std::vector<double> wishes(model.tets.size(), 0.0);
  for (std::size_t t = 0; t < model.tets.size(); ++t)
    for (int node : model.tets[t])
      if (of_node[node] > 0 && !(wishes[t] > 0 && wishes[t] < of_node[node])) wishes[t] = of_node[node];
  return wishes;
}

/// The smaller of two wishes for each tetrahedron; 0: none.
void take_smaller(std::vector<double>& wishes, const std::vector<double>& others) {
  wishes.resize(others.size(), 0.0);
  for (std::size_t t = 0; t < others.size(); ++t)
    if (others[t] > 0 && !(wishes[t] > 0 && wishes[t] < others[t])) wishes[t] = others[t];
}

/// Wishes that are met already are none; empty where none is left.
std::vector<double> unmet(const Model& model, const State& state, std::vector<double> wishes) {
  bool any = false;
  for (std::size_t t = 0; t < wishes.size(); ++t) {
    if (!(wishes[t] < longest_edge(model, state, model.tets[t]))) wishes[t] = 0;
    any = any || wishes[t] > 0;
  }
  return any ? wishes : std::vector<double>{};
}

/// Faces that a tool touches against its curvature and the contact's width; and all that is about them, if one of them is too coarse. Empty: none is.
std::vector<double> contact_marks(const Model& model, const State& state, const implicit::ContactSums& contact, const RemeshRules& rules) {
  constexpr int points = contact::points_per_face;
  constexpr double near = 1;  // face sizes from a tool: about to be touched
  std::vector<double> of_node(model.points.size(), 0.0), wishes;
  bool too_coarse = false;
  for (std::size_t i = 0; i < model.tools.size() && !contact.points.empty(); ++i) {
    const auto pose = implicit::pose(model, state, static_cast<int>(i));
    const auto first = contact.points.begin() + i * model.faces.size() * points;
    const Touched area = touched(model, state, &*first);
    const double by_width = std::max(rules.finest_mm, rules.part_of_contact * area.half_width);
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
      const auto corners = implicit::corners_now(model, state, static_cast<int>(f));
      const Vector3d centre = (corners[0] + corners[1] + corners[2]) / 3;
      const double longest = longest_edge(model, state, model.faces[f]);
      if (!(model.tools[i].distance(centre, pose).g < near * longest)) continue;
      const double asked = wish(model.tools[i], pose, centre, rules);
      const bool touches = std::any_of(first + f * points, first + (f + 1) * points, [](const contact::Point& p) { return p.pressure > 0; });
      too_coarse = too_coarse || (touches && longest > std::min(asked, by_width));
      for (int node : model.faces[f]) of_node[node] = of_node[node] > 0 ? std::min(of_node[node], asked) : asked;
    }
    if (!area.places.empty()) take_smaller(wishes, width_wishes(model, state, area, rules));
  }
  if (!too_coarse) return {};
  take_smaller(wishes, spread(model, of_node));
  return unmet(model, state, std::move(wishes));
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
  take_smaller(asked, of_shape);
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
  return unmet(model, state, spread(model, of_node));
}

double default_finest(const Model& model) {
  double sum = 0;
  for (const auto& f : model.faces)
    for (int k = 0; k < 3; ++k) sum += (model.points[f[k]] - model.points[f[(k + 1) % 3]]).norm();
  return sum / (3 * model.faces.size()) / 2;
}

}  // namespace palpate
