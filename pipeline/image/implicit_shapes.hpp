// Solids as functions of space: f(x) < 0 inside, > 0 outside, |f| at most the distance to the boundary (|∇f| ≤ 1).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

#include <palpate/vec3.hpp>

namespace palpate {

/// f(x) in mm for a point in mm. Every shape and combination below keeps |∇f| ≤ 1, so a ball of radius |f(x)| around x is all
/// inside or all outside.
using Implicit = std::function<double(const Vec3&)>;

/// Axis-aligned box in mm.
struct Box {
  Vec3 min{0, 0, 0}, max{0, 0, 0};
};

Implicit ball(const Vec3& centre, double radius);
/// All points within `radius` of the segment a–b.
Implicit capsule(const Vec3& a, const Vec3& b, double radius);
/// The convex hull of two balls; requires |ra − rb| < |a − b|.
Implicit round_cone(const Vec3& a, double ra, const Vec3& b, double rb);
/// All points within `radius` of the circular arc centre + R (cos θ, 0, sin θ), |θ| ≤ half_angle ≤ π (π: a torus).
Implicit arc_tube(const Vec3& centre, double arc_radius, double half_angle, double radius);
/// All points within `radius` of the polyline.
Implicit polyline_tube(const std::vector<Vec3>& points, double radius);

/// min(a, b) with the crease filled over `width` (quadratic polynomial minimum; Quilez 2013). `width` 0: sharp.
Implicit smooth_union(Implicit a, Implicit b, double width);
/// a without b, the edge rounded over `width`.
Implicit smooth_difference(Implicit a, Implicit b, double width);
Implicit intersection(Implicit a, Implicit b);
/// Grown by `distance` (shrunk when negative).
Implicit offset(Implicit a, double distance);
/// Stretched by `factors` along x, y, z about the origin.
Implicit stretched(Implicit a, const Vec3& factors);
/// Moved by a rotation and translation, given as the map from the shape's own frame to the new one.
Implicit moved(Implicit a, const Affine& new_from_own);

/// ∇f by central differences of step `step` mm.
Vec3 gradient(const Implicit& f, const Vec3& x, double step);
/// A point of f = 0 near x by Newton's method along ∇f; stays within `reach` mm of x.
Vec3 project_to_zero(const Implicit& f, const Vec3& x, double reach);

}  // namespace palpate
