// Where a finer mesh of the same rest shape comes from.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <solver/contact/triangle_tree.hpp>
#include <solver/implicit/carry.hpp>

namespace palpate::verify {

using Eigen::Vector3d;

/// Every node by the corners of an old tetrahedron that holds it, every face by the one that it lies in.
inline implicit::Origins origins_in(const implicit::Model& old_model, const implicit::Model& model) {
  implicit::Origins origins;
  for (const auto& x : model.points)
    for (const auto& tet : old_model.tets) {
      Eigen::Matrix4d corners;
      for (int a = 0; a < 4; ++a) corners.col(a) << old_model.points[tet[a]], 1;
      const Eigen::Vector4d weights = corners.inverse() * Eigen::Vector4d(x.x(), x.y(), x.z(), 1);
      if (!(weights.minCoeff() >= -1e-12)) continue;
      origins.nodes.push_back(tet);
      origins.weights.push_back({weights(0), weights(1), weights(2), weights(3)});
      break;
    }
  origins.tets.assign(model.tets.size(), 0);
  for (int f = 0; f < int(model.faces.size()); ++f) {
    const auto c = implicit::corners_at_rest(model, f);
    const Vector3d middle = (c[0] + c[1] + c[2]) / 3;
    int parent = -1;
    for (int o = 0; o < int(old_model.faces.size()) && parent < 0; ++o)
      if (contact::nearest_on_triangle(middle, implicit::corners_at_rest(old_model, o)).squared_distance < 1e-20) parent = o;
    origins.faces.push_back(parent);
  }
  return origins;
}

}  // namespace palpate::verify
