// Every edge has exactly two triangles; the operations keep it so.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/mesh/tri_complex.hpp>

#include <algorithm>

namespace palpate {

TriComplex::TriComplex(const Surface& surface) : points_(surface.points), star_(surface.points.size()) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) add(surface.triangles[t], surface.triangle_region[t]);
}

int TriComplex::add(const Triangle& corners, int region) {
  const int t = static_cast<int>(triangles_.size());
  triangles_.push_back(corners);
  region_.push_back(region);
  alive_.push_back(true);
  for (int i : corners) star_[i].push_back(t);
  return t;
}

void TriComplex::remove(int t) {
  alive_[t] = false;
  for (int i : triangles_[t]) std::erase(star_[i], t);
}

void TriComplex::put(int t, const Triangle& corners) {
  for (int i : triangles_[t]) std::erase(star_[i], t);
  triangles_[t] = corners;
  for (int i : corners) star_[i].insert(std::lower_bound(star_[i].begin(), star_[i].end(), t), t);
}

Vec3 TriComplex::normal(const Triangle& t) const { return cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]); }

Vec3 TriComplex::normal_with(int triangle, int node, const Vec3& x) const {
  Vec3 p[3];
  for (int k = 0; k < 3; ++k) p[k] = triangles_[triangle][k] == node ? x : points_[triangles_[triangle][k]];
  return cross(p[1] - p[0], p[2] - p[0]);
}

std::vector<int> TriComplex::neighbours(int node) const {
  std::vector<int> nodes;
  for (int t : star_[node])
    for (int i : triangles_[t])
      if (i != node) nodes.push_back(i);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

TriEdge TriComplex::edge(int t, int corner) const {
  const Triangle& left = triangles_[t];
  TriEdge e{left[corner], left[(corner + 1) % 3], left[(corner + 2) % 3], -1, t, -1};
  for (int other : star_[e.a]) {
    if (other == t) continue;
    for (int k = 0; k < 3; ++k)
      if (triangles_[other][k] == e.b && triangles_[other][(k + 1) % 3] == e.a) {
        e.right = other;
        e.d = triangles_[other][(k + 2) % 3];
      }
  }
  return e;
}

std::vector<TriEdge> TriComplex::edges() const {
  std::vector<TriEdge> all;
  for (int t = 0; t < triangles_.size(); ++t)
    for (int k = 0; k < 3 && alive_[t]; ++k)
      if (triangles_[t][k] < triangles_[t][(k + 1) % 3]) all.push_back(edge(t, k));
  return all;
}

TriEdge TriComplex::find_edge(int a, int b) const {
  for (int t : star_[a])
    for (int k = 0; k < 3; ++k)
      if (triangles_[t][k] == a && triangles_[t][(k + 1) % 3] == b) return edge(t, k);
  return {a, b, -1, -1, -1, -1};
}

int TriComplex::split(const TriEdge& e, const Vec3& x) {
  const int m = static_cast<int>(points_.size());
  points_.push_back(x);
  star_.emplace_back();
  put(e.left, {e.a, m, e.c});
  put(e.right, {e.b, m, e.d});
  add({m, e.b, e.c}, region_[e.left]);
  add({m, e.a, e.d}, region_[e.right]);
  return m;
}

bool TriComplex::can_collapse(const TriEdge& e) const {
  const auto of_a = neighbours(e.a), of_b = neighbours(e.b);
  std::vector<int> both;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(both));
  return both.size() == 2 && star_[e.c].size() > 3 && star_[e.d].size() > 3;
}

void TriComplex::collapse(const TriEdge& e, const Vec3& x) {
  remove(e.left);
  remove(e.right);
  for (int t : std::vector<int>(star_[e.b])) {
    Triangle corners = triangles_[t];
    std::replace(corners.begin(), corners.end(), e.b, e.a);
    put(t, corners);
  }
  points_[e.a] = x;
}

bool TriComplex::can_flip(const TriEdge& e) const {
  const auto of_c = neighbours(e.c);
  return region_[e.left] == region_[e.right] && star_[e.a].size() > 3 && star_[e.b].size() > 3 && !std::binary_search(of_c.begin(), of_c.end(), e.d);
}

void TriComplex::flip(const TriEdge& e) {
  put(e.left, {e.c, e.a, e.d});
  put(e.right, {e.d, e.b, e.c});
}

Surface TriComplex::surface(const RegionNames& names) const {
  Surface s;
  s.region_names = names;
  std::vector<int> index(points_.size(), -1);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (star_[i].empty()) continue;
    index[i] = static_cast<int>(s.points.size());
    s.points.push_back(points_[i]);
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (!alive_[t]) continue;
    s.triangles.push_back({index[triangles_[t][0]], index[triangles_[t][1]], index[triangles_[t][2]]});
    s.triangle_region.push_back(region_[t]);
  }
  return s;
}

}  // namespace palpate
