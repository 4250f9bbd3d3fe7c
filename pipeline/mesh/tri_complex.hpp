// A closed triangle surface that is split, collapsed and flipped edge by edge, with the star of every node kept up to date.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

using Triangle = std::array<int, 3>;

/// A directed edge a→b of triangle `left`; the triangle on the other side is `right`; c and d are the corners opposite.
struct TriEdge {
  int a, b, c, d, left, right;
};

class TriComplex {
 public:
  explicit TriComplex(const Surface& surface);

  std::size_t node_count() const { return points_.size(); }
  std::size_t size() const { return triangles_.size(); }
  bool alive(int triangle) const { return alive_[triangle]; }
  const Triangle& triangle(int triangle) const { return triangles_[triangle]; }
  const Vec3& point(int node) const { return points_[node]; }
  const std::vector<int>& star(int node) const { return star_[node]; }
  void move(int node, const Vec3& x) { points_[node] = x; }

  /// Twice the area vector; of a triangle with one node elsewhere.
  Vec3 normal(const Triangle& t) const;
  Vec3 normal_with(int triangle, int node, const Vec3& x) const;
  double length(int a, int b) const { return norm(points_[a] - points_[b]); }
  std::vector<int> neighbours(int node) const;  ///< ascending

  /// Edge `corner` → next corner of a triangle.
  TriEdge edge(int triangle, int corner) const;
  /// All edges once, a < b, in order of their triangle.
  std::vector<TriEdge> edges() const;
  /// The edge a-b, when it still is one; `left` is -1 otherwise.
  TriEdge find_edge(int a, int b) const;

  int split(const TriEdge& e, const Vec3& x);        ///< the new node
  bool can_collapse(const TriEdge& e) const;         ///< link condition: the ends share exactly two neighbours
  void collapse(const TriEdge& e, const Vec3& x);    ///< b is drawn onto a, which goes to x
  bool can_flip(const TriEdge& e) const;             ///< c-d is no edge yet, and a and b keep three neighbours
  void flip(const TriEdge& e);

  Surface surface(const RegionNames& names) const;

 private:
  void put(int triangle, const Triangle& corners);
  int add(const Triangle& corners, int region);
  void remove(int triangle);

  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<int> region_;
  std::vector<bool> alive_;
  std::vector<std::vector<int>> star_;
};

}  // namespace palpate
