// Closed test surfaces with known volume: balls (also stretched and bent to a bean) and tori.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <numbers>

#include <palpate/mesh_files.hpp>

namespace palpate::shapes {

inline void turn(Surface& surface) {
  for (auto& t : surface.triangles) std::swap(t[1], t[2]);
}

/// Adds `other` behind `surface`.
inline void append(Surface& surface, const Surface& other) {
  const int base = static_cast<int>(surface.points.size());
  surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
  for (const auto& t : other.triangles) surface.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  surface.triangle_region.insert(surface.triangle_region.end(), other.triangle_region.begin(), other.triangle_region.end());
  surface.region_names.insert(other.region_names.begin(), other.region_names.end());
}

/// A subdivided icosahedron on the ball; 20·4^levels triangles.
inline Surface ball(const Vec3& centre, double radius, int levels, int region = 1, const std::string& name = "ball") {
  const double g = std::numbers::phi;
  Surface s;
  s.points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  s.triangles = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                 {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto mid = [&](int a, int b) {
      const auto [at, fresh] = middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(s.points.size()));
      if (fresh) s.points.push_back(0.5 * (unit(s.points[a]) + unit(s.points[b])));
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const int ab = mid(a, b), bc = mid(b, c), ca = mid(c, a);
      for (const auto& t : {std::array{a, ab, ca}, std::array{b, bc, ab}, std::array{c, ca, bc}, std::array{ab, bc, ca}}) finer.push_back(t);
    }
    s.triangles = finer;
  }
  for (auto& p : s.points) p = centre + radius * unit(p);
  s.triangle_region.assign(s.triangles.size(), region);
  s.region_names = {{region, name}};
  return s;
}

/// A ball stretched to the half axes and bent along its length, like a kidney.
inline Surface bean(const Vec3& half_axes, double bend, int levels) {
  Surface s = ball({0, 0, 0}, 1, levels, 1, "kidney");
  for (auto& p : s.points) {
    p = {half_axes[0] * p[0], half_axes[1] * p[1], half_axes[2] * p[2]};
    p[1] -= bend * p[0] * p[0] / (half_axes[0] * half_axes[0]);
  }
  return s;
}

/// Torus about z: 2·rings·sides triangles.
inline Surface torus(double major, double minor, int rings, int sides) {
  Surface s;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const double u = 2 * std::numbers::pi * i / rings, v = 2 * std::numbers::pi * j / sides, r = major + minor * std::cos(v);
      s.points.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
      const int a = i * sides + j, b = (i + 1) % rings * sides + j, c = (i + 1) % rings * sides + (j + 1) % sides, d = i * sides + (j + 1) % sides;
      s.triangles.push_back({a, b, c});
      s.triangles.push_back({a, c, d});
    }
  s.triangle_region.assign(s.triangles.size(), 1);
  s.region_names = {{1, "ring"}};
  return s;
}

}  // namespace palpate::shapes
