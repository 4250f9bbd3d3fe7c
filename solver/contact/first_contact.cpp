// Where a tool first touches a surface: it goes on by the least distance of a triangle, which is a safe step (sphere tracing: Hart 1996,
// The Visual Computer 12:527). A tool that is convex has a distance that is convex on a triangle: its least value is found by golden sections.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/contact/tool_contact.hpp>

#include <algorithm>
#include <limits>

namespace palpate::contact {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

/// Least value of a convex function on [0, 1], to the last digits.
template <class Function>
double least_of(const Function& f) {
  constexpr double golden = 0.6180339887498949;
  constexpr int cuts = 40;
  double low = 0, high = 1, x = 1 - golden, y = golden, fx = f(x), fy = f(y);
  for (int i = 0; i < cuts; ++i) {
    const bool left = fx < fy;
    (left ? high : low) = left ? y : x;
    (left ? y : x) = left ? x : y;
    (left ? fy : fx) = left ? fx : fy;
    double& fresh = left ? x : y;
    fresh = left ? high - golden * (high - low) : low + golden * (high - low);
    (left ? fx : fy) = f(fresh);
  }
  return std::min(fx, fy);
}

/// Of the triangle, if that is less than `so_far`.
double least_distance(const Tool& tool, double travel, const Corners& c, double so_far) {
  int lowest = 0;
  std::array<tools::Distance, 3> d;
  for (int a = 0; a < 3; ++a) {
    d[a] = tool.distance(c[a], travel);
    if (d[a].g < d[lowest].g) lowest = a;
  }
  const double at_corner = d[lowest].g, size = std::max((c[(lowest + 1) % 3] - c[lowest]).norm(), (c[(lowest + 2) % 3] - c[lowest]).norm());
  const auto rises_to = [&](int a) { return d[lowest].n.dot(c[a] - c[lowest]) >= -1e-9 * size; };
  if (rises_to((lowest + 1) % 3) && rises_to((lowest + 2) % 3)) return std::min(so_far, at_corner);
  if (at_corner - size >= so_far) return so_far;  // no point is farther from the corner than its longer edge
  const double inside = least_of([&](double u) {
    return least_of([&](double v) { return tool.distance((1 - u) * c[0] + u * ((1 - v) * c[1] + v * c[2]), travel).g; });
  });
  return std::min({so_far, at_corner, inside});
}

}  // namespace

bool find_first_contact(Tool& tool, const Vector3d& aim, const std::vector<Corners>& surface) {
  double back = 0, front = 0;  // how far the surface reaches along the axis, seen from the aim
  for (const auto& triangle : surface)
    for (const auto& x : triangle) {
      back = std::max(back, (aim - x).dot(tool.axis));
      front = std::max(front, (x - aim).dot(tool.axis));
    }
  const double touching = 1e-5 * (back + front);  // finer, and a tool that grazes the organ would creep along it
  tool.first_contact = aim - (back + 1e-3 * (back + front)) * tool.axis;
  double travel = 0;
  while (travel <= 2 * (back + front)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& triangle : surface)
      for (const auto& x : triangle) nearest = std::min(nearest, tool.distance(x, travel).g);
    for (const auto& triangle : surface) nearest = least_distance(tool, travel, triangle, nearest);
    if (nearest <= touching) {
      tool.first_contact += (travel + nearest) * tool.axis;
      return true;
    }
    travel += std::max(nearest, touching);
  }
  return false;
}

}  // namespace palpate::contact
