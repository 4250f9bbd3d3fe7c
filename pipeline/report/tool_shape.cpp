// Profiles (r, z): r from the line, z behind the tip. Ball: r = R sin a, z = R (1 − cos a). Rounded edge: r = R − e + e sin a.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/tool_shape.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>

namespace palpate {
namespace {

using std::numbers::pi;

constexpr int turns = 128, arc_steps = 24;

/// An arc of radius e around (straight, height) from one angle to another; 0 looks ahead, π/2 outward.
void add_arc(std::vector<Ring>& rings, std::array<double, 2> straight, double inner, double e, double height, double from, double to) {
  for (int i = 0; i <= arc_steps; ++i) {
    const double a = from + (to - from) * i / arc_steps;
    rings.push_back({straight, inner + e * std::sin(a), height - e * std::cos(a)});
  }
}

std::vector<Ring> between_points(std::vector<Ring> rings) {
  rings.insert(rings.begin(), {{0, 0}, 0, rings.front().height});
  rings.push_back({{0, 0}, 0, rings.back().height});
  return rings;
}

double size_of(const Json& json, const char* name) { return json.at(name).get<double>(); }

void ball(const Json& json, double, Tool& tool) {
  const double R = tool.radius_mm = size_of(json, "radius_mm");
  add_arc(tool.rings, {0, 0}, 0, R, R, 0, pi / 2);
  add_arc(tool.rings, {0, 0}, 0, R, R, pi / 2, pi);
}

void shank(Tool& tool) { tool.rings.push_back({{0, 0}, tool.radius_mm, 3 * tool.radius_mm}); }

void rod(const Json& json, double, Tool& tool) {
  const double R = tool.radius_mm = size_of(json, "radius_mm");
  add_arc(tool.rings, {0, 0}, 0, R, R, 0, pi / 2);
  shank(tool);
}

void flat_punch(const Json& json, double, Tool& tool) {
  const double R = tool.radius_mm = size_of(json, "radius_mm"), e = std::min(size_of(json, "edge_radius_mm"), R);
  add_arc(tool.rings, {0, 0}, R - e, e, e, 0, pi / 2);
  shank(tool);
}

void rounded_punch(const Json& json, double, Tool& tool) {
  const double a = tool.radius_mm = size_of(json, "radius_mm"), R = std::max(size_of(json, "dome_radius_mm"), a);
  const double e = std::min(size_of(json, "edge_radius_mm"), a), above_rim = std::sqrt((R - e) * (R - e) - (a - e) * (a - e));
  const double meet = std::atan2(a - e, above_rim);
  add_arc(tool.rings, {0, 0}, 0, R, R, 0, meet);
  add_arc(tool.rings, {0, 0}, a - e, e, R - above_rim, meet, pi / 2);
  shank(tool);
}

/// A block between two heights, all edges rounded by e.
void add_block(Tool& tool, double width, double length, double height, double e) {
  const std::array<double, 2> straight = {width / 2 - e, length / 2 - e};
  add_arc(tool.rings, straight, 0, e, e, 0, pi / 2);
  add_arc(tool.rings, straight, 0, e, height - e, pi / 2, pi);
  tool.radius_mm = std::min(width, length) / 2;
}

void box(const Json& json, double, Tool& tool) {
  const double width = size_of(json, "width_mm"), length = size_of(json, "length_mm"), height = size_of(json, "height_mm");
  add_block(tool, width, length, height, std::min({size_of(json, "edge_radius_mm"), width / 2, length / 2, height / 2}));
}

void plane(const Json&, double organ_mm, Tool& tool) {
  add_block(tool, organ_mm, organ_mm, organ_mm / 20, 0);
  tool.radius_mm = organ_mm / 8;
}

void cylinder(const Json& json, double, Tool& tool) {
  const double R = tool.radius_mm = tool.across_rings_mm = size_of(json, "radius_mm"), half = size_of(json, "length_mm") / 2;
  const double e = std::min({size_of(json, "edge_radius_mm"), R, half});
  add_arc(tool.rings, {0, 0}, R - e, e, e - half, 0, pi / 2);
  add_arc(tool.rings, {0, 0}, R - e, e, half - e, pi / 2, pi);
}

}  // namespace

bool shape_tool(const Json& json, double organ_mm, Tool& tool) {
  static const std::map<std::string, std::function<void(const Json&, double, Tool&)>> shapes = {
      {"ball", ball}, {"box", box}, {"cylinder", cylinder}, {"flat_punch", flat_punch}, {"plane", plane}, {"rod", rod}, {"rounded_punch", rounded_punch}};
  const auto shape = shapes.find(json.at("kind").get<std::string>());
  if (shape == shapes.end()) return false;
  shape->second(json, organ_mm, tool);
  tool.rings = between_points(std::move(tool.rings));
  return true;
}

ToolSurface tool_surface(const Tool& tool) {
  const bool lying = tool.across_rings_mm >= 0;
  const Vec3 line = lying ? tool.across : -1.0 * tool.axis;
  const Vec3 origin = lying ? tool.tip_mm - tool.across_rings_mm * tool.axis : tool.tip_mm;
  const Vec3 u = lying ? tool.axis : tool.across, v = cross(line, u);
  ToolSurface shell;
  for (const Ring& ring : tool.rings)
    for (int t = 0; t < turns; ++t) {
      const int quadrant = 4 * t / turns;  // its corners' arcs, then straight on to the next one
      const double angle = pi / 2 * (quadrant + double(t % (turns / 4)) / (turns / 4 - (ring.straight[0] > 0)));
      const double side_u = quadrant == 0 || quadrant == 3 ? 1 : -1, side_v = quadrant < 2 ? 1 : -1;
      shell.points.push_back(origin + ring.height * line + (side_u * ring.straight[0] + ring.radius * std::cos(angle)) * u +
                             (side_v * ring.straight[1] + ring.radius * std::sin(angle)) * v);
    }
  for (int ring = 0; ring + 1 < static_cast<int>(tool.rings.size()); ++ring)
    for (int t = 0; t < turns; ++t) {
      const int a = ring * turns + t, b = ring * turns + (t + 1) % turns;
      shell.triangles.push_back({a, b, a + turns});
      shell.triangles.push_back({b, b + turns, a + turns});
    }
  return shell;
}

std::vector<Vec3> tool_section(const Tool& tool, const Vec3& sideways) {
  const Vec3 normal = cross(tool.axis, sideways);
  const ToolSurface shell = tool_surface(tool);
  std::vector<Vec3> crossings;
  for (const auto& t : shell.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = shell.points[t[k]], &b = shell.points[t[(k + 1) % 3]];
      const double from = dot(a - tool.tip_mm, normal), to = dot(b - tool.tip_mm, normal);
      if ((from < 0) != (to < 0)) crossings.push_back(a + (from / (from - to)) * (b - a));
    }
  Vec3 middle{0, 0, 0};
  for (const Vec3& p : crossings) middle = middle + (1.0 / crossings.size()) * p;
  const auto turn = [&](const Vec3& p) { return std::atan2(dot(p - middle, tool.axis), dot(p - middle, sideways)); };
  std::sort(crossings.begin(), crossings.end(), [&](const Vec3& p, const Vec3& q) { return turn(p) < turn(q); });
  return crossings;  // all these tools are convex
}

}  // namespace palpate
