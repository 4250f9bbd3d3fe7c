// Tetrahedra that are replaced a few at a time, with the star of every node and the quality of every tetrahedron kept up to date.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

using Tet = std::array<int, 4>;

class TetComplex {
 public:
  explicit TetComplex(const TetMesh& mesh);

  const std::vector<Vec3>& points() const { return points_; }
  std::size_t size() const { return tets_.size(); }
  bool alive(int tet) const { return alive_[tet]; }
  const Tet& tet(int tet) const { return tets_[tet]; }
  int region(int tet) const { return region_[tet]; }
  double quality(int tet) const { return quality_[tet]; }
  /// Tetrahedra at a node, ascending.
  const std::vector<int>& star(int node) const { return star_[node]; }

  double quality_of(const Tet& tet) const;
  double worst_of(const std::vector<int>& tets) const;
  double worst_of(const std::vector<Tet>& tets) const;
  /// Worst quality of the star of `node`, were it at `x`; stops early below `floor`.
  double worst_with(int node, const Vec3& x, double floor) const;

  void move(int node, const Vec3& x);
  int add_point(const Vec3& x);
  void replace(const std::vector<int>& old, const std::vector<Tet>& fresh);

  /// Tetrahedra that hold both nodes, ascending.
  std::vector<int> around_edge(int a, int b) const;
  /// The nodes around edge a→b, counter-clockwise seen against it; empty for an edge of the boundary or of an interface.
  std::vector<int> ring(int a, int b, const std::vector<int>& around) const;
  /// The other tetrahedron at the face opposite corner `corner`; -1 at the boundary.
  int neighbour(int tet, int corner) const;

  /// Living tetrahedra in order, points without a tetrahedron removed.
  void write_to(TetMesh& mesh) const;

 private:
  std::vector<Vec3> points_;
  std::vector<Tet> tets_;
  std::vector<int> region_;
  std::vector<bool> alive_;
  std::vector<double> quality_;
  std::vector<std::vector<int>> star_;
};

/// The other two corners of a tetrahedron such that (a, b, c, d) has its orientation.
std::array<int, 2> opposite_edge(const Tet& tet, int a, int b);

/// (apex, p, q, r) with the orientation of the tetrahedron, the apex being its corner `corner`.
Tet with_apex(const Tet& tet, int corner);

}  // namespace palpate
