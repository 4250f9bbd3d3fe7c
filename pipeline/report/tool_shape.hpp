// A rigid tool at the end of its way, as a shape of revolution about its axis.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include <palpate/vec3.hpp>

namespace palpate {

struct Tool {
  std::string kind;  ///< "ball", "rod" (hemispherical tip) or "flat_punch"
  double radius_mm = 0;
  double edge_radius_mm = 0;  ///< of a flat punch
  Vec3 tip_mm{0, 0, 0};       ///< the foremost point, on the axis
  Vec3 axis{0, 0, 1};         ///< unit vector of its motion, into the organ
};

struct ToolSurface {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

/// Its surface, closed.
ToolSurface tool_surface(const Tool& tool);

/// Its cut along the axis as a closed polygon (the last point joins the first); `sideways` is a unit vector at right angles to
/// the axis.
std::vector<Vec3> tool_section(const Tool& tool, const Vec3& sideways);

}  // namespace palpate
