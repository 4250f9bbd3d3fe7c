// Several organs in one model, and contact between them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <numeric>

#include <tests/verify/shapes.hpp>

namespace palpate::verify {

/// Adds another organ's points, tetrahedra and faces.
inline void append(implicit::Model& model, const implicit::Model& organ) {
  const int first = static_cast<int>(model.points.size());
  model.points.insert(model.points.end(), organ.points.begin(), organ.points.end());
  for (auto tet : organ.tets) {
    for (int& node : tet) node += first;
    model.tets.push_back(tet);
  }
  for (auto face : organ.faces) {
    for (int& node : face) node += first;
    model.faces.push_back(face);
  }
  model.tet_material.resize(model.tets.size(), 0);
}

/// The faces before number `second` against those from there on.
inline void touch(implicit::Model& model, int second, double friction = 0) {
  std::vector<int> a(second), b(model.faces.size() - second);
  std::iota(a.begin(), a.end(), 0);
  std::iota(b.begin(), b.end(), second);
  model.passes = contact::passes_between(a, b, false, 0, friction);
}

/// What is left of a model without the tetrahedra whose centroids lie in `hole`, and without nodes that then belong to none.
inline implicit::Model without(const implicit::Model& whole, const std::function<bool(const Vector3d&)>& hole) {
  implicit::Model model;
  std::vector<int> number(whole.points.size(), -1);
  for (int t = 0; t < int(whole.tets.size()); ++t) {
    if (hole(implicit::centroid(whole, t))) continue;
    auto tet = whole.tets[t];
    for (int& node : tet) {
      if (number[node] < 0) {
        number[node] = model.points.size();
        model.points.push_back(whole.points[node]);
      }
      node = number[node];
    }
    model.tets.push_back(tet);
  }
  model.faces = boundary(model);
  model.tet_material.assign(model.tets.size(), 0);
  return model;
}

/// A tube around the z axis from z = 0 to `length`, its circle a polygon of `around` sides.
inline implicit::Model tube(double inner, double outer, double length, int around, int across, int along) {
  auto model = brick(uniform(0, around, around), uniform(inner, outer, across), uniform(0, length, along));
  std::map<int, int> twin;  // the last column of nodes is the first one
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (model.points[i].x() > around - 0.5) twin[i] = i - around;
  for (auto& tet : model.tets)
    for (int& node : tet)
      if (twin.contains(node)) node = twin[node];
  for (auto& x : model.points) {
    const double angle = 2 * M_PI * x.x() / around, r = x.y();
    x = {r * std::cos(angle), r * std::sin(angle), x.z()};
  }
  orient(model);
  return without(model, [](const Vector3d&) { return false; });
}

}  // namespace palpate::verify
