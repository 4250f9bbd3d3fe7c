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
inline void touch(implicit::Model& model, int second) {
  std::vector<int> a(second), b(model.faces.size() - second);
  std::iota(a.begin(), a.end(), 0);
  std::iota(b.begin(), b.end(), second);
  model.passes = contact::passes_between(a, b, false, 0);
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

}  // namespace palpate::verify
