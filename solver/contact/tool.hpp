// Rigid tools as signed distances in their own frame: the tip at the origin, the axis along −z (z grows into the shank).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <functional>
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
  /// `x` in the tool's frame; `parameters` in the order of entry.parameters.
  using Function = std::function<Distance(const Eigen::Vector3d& x, std::span<const double> parameters)>;
  CatalogueEntry entry;  ///< kind "tool"
  Function distance;     ///< empty for a shape that is in a file, until that is read
  Function (*read)(const std::filesystem::path& file) = nullptr;  ///< for such a shape. Throws Failure(unreadable)
};

/// Every tool of the folder (generated).
std::vector<Shape> all();

}  // namespace palpate::tools
