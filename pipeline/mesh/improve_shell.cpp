// Local search over the star of each point and the diamond of each edge.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/improve_shell.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <pipeline/mesh/shell_quality.hpp>

namespace palpate {
namespace {

using Triangle = std::array<int, 3>;

double skew(const Vec3& a, const Vec3& b, const Vec3& c) { return triangle_shape(a, b, c).equiangular_skew; }

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(b - a, c - a); }

/// The side of each directed edge.
std::map<std::pair<int, int>, int> sides_of(const std::vector<Triangle>& triangles) {
  std::map<std::pair<int, int>, int> sides;
  for (int t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) sides[{triangles[t][k], triangles[t][(k + 1) % 3]}] = t;
  return sides;
}

int opposite(const Triangle& t, int a, int b) {
  for (int i : t)
    if (i != a && i != b) return i;
  return -1;
}

/// One pass over the edges; returns how many were flipped. Each triangle takes part once a pass.
int flip_edges(ShellMesh& mesh) {
  const auto sides = sides_of(mesh.triangles);
  std::vector<char> used(mesh.triangles.size(), 0);
  std::set<std::pair<int, int>> made;
  int flips = 0;
  for (const auto& [edge, left] : sides) {
    const auto [a, b] = edge;
    const auto other = sides.find({b, a});
    if (a > b || other == sides.end() || used[left] || used[other->second]) continue;
    const int right = other->second, c = opposite(mesh.triangles[left], a, b), d = opposite(mesh.triangles[right], a, b);
    if (sides.contains({c, d}) || sides.contains({d, c}) || made.contains(std::minmax(c, d))) continue;
    const Vec3 &xa = mesh.points[a], &xb = mesh.points[b], &xc = mesh.points[c], &xd = mesh.points[d];
    const Vec3 up = area_vector(xa, xb, xc) + area_vector(xb, xa, xd);
    if (dot(area_vector(xa, xd, xc), up) <= 0 || dot(area_vector(xd, xb, xc), up) <= 0) continue;
    if (std::max(skew(xa, xd, xc), skew(xd, xb, xc)) >= std::max(skew(xa, xb, xc), skew(xb, xa, xd)) - 1e-9) continue;
    mesh.triangles[left] = {a, d, c};
    mesh.triangles[right] = {d, b, c};
    used[left] = used[right] = 1;
    made.insert(std::minmax(c, d));
    ++flips;
  }
  return flips;
}

double worst_around(const ShellMesh& mesh, const std::vector<int>& star) {
  double worst = 0;
  for (int t : star) {
    const auto& [a, b, c] = mesh.triangles[t];
    worst = std::max(worst, skew(mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return worst;
}

void move_points(ShellMesh& mesh, const SurfaceIndex& surface) {
  std::vector<std::vector<int>> stars(mesh.points.size());
  for (int t = 0; t < mesh.triangles.size(); ++t)
    for (int i : mesh.triangles[t]) stars[i].push_back(t);
  for (int i = 0; i < mesh.points.size(); ++i) {
    if (mesh.end[i] != 0) continue;
    Vec3 mean{0, 0, 0};
    for (int t : stars[i])
      for (int j : mesh.triangles[t]) mean = mean + (j == i ? 0.0 : 0.5 / stars[i].size()) * mesh.points[j];
    const Vec3 before = mesh.points[i];
    double worst = worst_around(mesh, stars[i]);
    for (double part : {1.0, 0.5, 0.25}) {
      Vec3& x = mesh.points[i];
      const Vec3 kept = x;
      x = surface.nearest(before + part * (mean - before)).point;
      const double now = worst_around(mesh, stars[i]);
      if (now < worst) worst = now;
      else x = kept;
    }
  }
}

}  // namespace

void improve_shell(ShellMesh& mesh, const SurfaceIndex& surface, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    while (flip_edges(mesh) > 0) {}
    move_points(mesh, surface);
  }
}

}  // namespace palpate
