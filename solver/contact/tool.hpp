// Rigid tools as signed distances in their own frame: the tip at the origin, the axis along −z (z grows into the shank).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <span>
#include <vector>

#include <palpate/catalogue.hpp>

namespace palpate::tools {

/// Signed distance g (mm, negative inside), its gradient n (unit, outward) and Hessian (1/mm).
struct Distance {
  double g = 0;
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

struct Shape {
  CatalogueEntry entry;  ///< kind "tool"
  /// `x` in the tool's frame; `parameters` in the order of entry.parameters.
  Distance (*distance)(const Eigen::Vector3d& x, std::span<const double> parameters) = nullptr;
};

/// Every tool of the folder (generated).
std::vector<Shape> all();

}  // namespace palpate::tools
