// A rigid tool at the end of its way, as rings of points around a line: circles of a shape of revolution, rounded rectangles of a block.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <palpate/json.hpp>
#include <palpate/vec3.hpp>

namespace palpate {

/// A ring: half the straight sides of its outline and the radius of its corners, at a height behind the tip or along the line, mm.
struct Ring {
  std::array<double, 2> straight{0, 0};
  double radius = 0;
  double height = 0;
};

struct Tool {
  std::vector<Ring> rings;       ///< the first and the last ones shrunk to a point
  double across_rings_mm = -1;   ///< not negative: the rings follow one another along `across`, this far behind the tip
  double radius_mm = 0;          ///< how large it is near the contact
  Vec3 tip_mm{0, 0, 0};          ///< the foremost point, on the axis
  Vec3 axis{0, 0, 1};            ///< unit vector of its motion, into the organ
  Vec3 across{1, 0, 0};          ///< unit vector at right angles to the axis
};

/// The shape a solve's summary tells of by kind and sizes; false for a kind that is not drawn. `organ_mm`: how large a plane is drawn.
/// Throws Json::exception for sizes that are missing.
bool shape_tool(const Json& json, double organ_mm, Tool& tool);

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
