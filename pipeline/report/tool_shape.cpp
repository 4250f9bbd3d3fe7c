// Profiles (r, z): r from the axis, z behind the tip. Ball: r = R sin a, z = R (1 − cos a).
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/tool_shape.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate {
namespace {

using std::numbers::pi;
using ProfilePoint = std::array<double, 2>;

/// From the tip on the axis outward and back to the axis.
std::vector<ProfilePoint> profile(const Tool& tool) {
  std::vector<ProfilePoint> points{{0, 0}};
  const double R = tool.radius_mm, e = tool.kind == "flat_punch" ? std::min(tool.edge_radius_mm, R) : R;
  constexpr int arc_steps = 96;
  if (tool.kind == "ball") {
    for (int i = 1; i < arc_steps; ++i)
      points.push_back({R * std::sin(pi * i / arc_steps), R * (1 - std::cos(pi * i / arc_steps))});
    points.push_back({0, 2 * R});
    return points;
  }
  for (int i = 0; i <= arc_steps / 4; ++i) {
    const double a = pi / 2 * i / (arc_steps / 4);
    points.push_back({R - e + e * std::sin(a), e * (1 - std::cos(a))});
  }
  points.push_back({R, 3 * R});
  points.push_back({0, 3 * R});
  return points;
}

}  // namespace

ToolSurface tool_surface(const Tool& tool) {
  constexpr int turns = 64;
  const auto points = profile(tool);
  const Vec3 u = unit(cross(tool.axis, std::abs(tool.axis[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const Vec3 v = cross(tool.axis, u);
  ToolSurface shell;
  const int rings = static_cast<int>(points.size());
  for (const auto& [r, z] : points)
    for (int t = 0; t < turns; ++t) {
      const double angle = 2 * pi * t / turns;
      shell.points.push_back(tool.tip_mm - z * tool.axis + (r * std::cos(angle)) * u + (r * std::sin(angle)) * v);
    }
  for (int ring = 0; ring + 1 < rings; ++ring)
    for (int t = 0; t < turns; ++t) {
      const int a = ring * turns + t, b = ring * turns + (t + 1) % turns;
      shell.triangles.push_back({a, a + turns, b});
      shell.triangles.push_back({b, a + turns, b + turns});
    }
  return shell;
}

std::vector<Vec3> tool_section(const Tool& tool, const Vec3& sideways) {
  const auto half = profile(tool);
  std::vector<Vec3> polygon;
  const auto add = [&](const ProfilePoint& p, double side) {
    polygon.push_back(tool.tip_mm - p[1] * tool.axis + (side * p[0]) * sideways);
  };
  for (const auto& p : half) add(p, 1);
  for (std::size_t i = half.size() - 1; i-- > 1;) add(half[i], -1);
  return polygon;
}

}  // namespace palpate
