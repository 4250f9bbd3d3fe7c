// A tetrahedral mesh under change that knows where it came from: every node as a material point of the first mesh, every cell by its parent there.
// Nodes have a place in the deformed body, and may have one in its rest shape; both are linear in the same weights, so that volumes are kept.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include <palpate/mesh_files.hpp>

namespace palpate {

/// x = Σ weights[i] · (old node nodes[i]); weights sum to 1, unused ones are 0.
struct Origin {
  std::array<int, 4> nodes{0, 0, 0, 0};
  std::array<double, 4> weights{1, 0, 0, 0};
};

class CarriedMesh {
 public:
  /// `rest`: one place per point, or empty.
  CarriedMesh(const TetMesh& mesh, std::vector<Vec3> rest);

  using Tet = std::array<int, 4>;
  const std::vector<Vec3>& points() const { return now_; }
  const std::vector<Vec3>& rest() const { return rest_; }
  std::size_t tets() const { return tets_.size(); }
  bool alive(int tet) const { return alive_[tet]; }
  const Tet& tet(int tet) const { return tets_[tet]; }
  int parent(int tet) const { return parent_[tet]; }
  /// Living tetrahedra at a node, ascending; at an edge.
  const std::vector<int>& star(int node) const { return star_[node]; }
  std::vector<int> around(int a, int b) const;

  /// Square of an edge's length, now and at rest together, mm².
  double size2(int a, int b) const;

  /// A new node at a + t (b − a); every tetrahedron and listed face at the edge becomes two. Returns the node.
  int split(int a, int b, double t = 0.5);
  /// Moves a node to a + t (b − a), if its tetrahedra keep `share` of their volumes, now and at rest, and no listed face is at the node. Returns
  /// whether it did; parents then hold their tetrahedra nearly.
  bool slide(int a, int b, double t, double share);

  struct Result {
    TetMesh mesh;                    ///< places now
    std::vector<Vec3> rest;          ///< or empty
    std::vector<Origin> origins;     ///< of the nodes
    std::vector<int> tet_parents, face_parents;  ///< in the first mesh; −1 for a lip
  };
  /// Old nodes first, in their order.
  Result result() const;

 private:
  void add_tet(const Tet& tet, int like);
  void remove_tet(int tet);

  RegionNames region_names_;
  std::vector<Vec3> now_, rest_;
  std::vector<Origin> origins_;
  std::vector<Tet> tets_;
  std::vector<char> alive_;
  std::vector<int> parent_, region_;
  std::vector<std::vector<int>> star_;       ///< of the nodes
  std::vector<std::array<int, 3>> faces_;
  std::vector<int> face_parent_, face_region_;
  std::vector<std::vector<int>> face_star_;  ///< listed faces at each node, not in order
};

}  // namespace palpate
