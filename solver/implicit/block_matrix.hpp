// A sparse matrix of 4 × 4 blocks, one for every pair of nodes that share a tetrahedron or that contact brings together: the lower
// triangle of its symmetric part, and of its skew part where the forces have no potential.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

#include <solver/archive.hpp>

namespace palpate::implicit {

using Block = Eigen::Matrix4d;

class BlockMatrix {
 public:
  BlockMatrix(int nodes, const std::vector<std::array<int, 4>>& tets, bool symmetric = true);

  /// Makes room for the blocks of more pairs of nodes, i > j, and sets all values to zero; false, and nothing done, when there was room.
  bool extend(const std::vector<std::array<int, 2>>& pairs);
  /// Counts the extensions: a new pattern needs a new analysis.
  int extensions() const { return extensions_; }

  void set_zero(int threads = 1);
  /// Adds the block of nodes (i, j); (j, i) is its transpose and is not added separately.
  void add(int i, int j, const Block& block);
  /// Adds the blocks (i, j) and (j, i); for i = j both are the same one. Of a symmetric matrix the symmetric part is taken.
  /// `stiffness` (N/mm) on the diagonal of every displacement.
  void add_to_displacements(double stiffness);
  void add_both(int i, int j, const Block& ij, const Block& ji);
  /// Adds the symmetric matrix of tetrahedron `tet`, node by node; its blocks' places are known beforehand.
  void add_tet(int tet, const Eigen::Matrix<double, 16, 16>& matrix);

  int nodes() const { return static_cast<int>(row_start_.size()) - 1; }
  bool symmetric() const { return skew_.empty(); }
  /// Entries in coordinate form, one-based, in a fixed order: the lower triangle alone of a symmetric matrix.
  void coordinates(std::vector<int>& rows, std::vector<int>& columns) const;
  /// Their values; rows and columns of `fixed` unknowns become those of the identity.
  void values(const std::vector<char>& fixed, std::vector<double>& out, int threads = 1) const;
  /// Pattern and values, of a matrix of the same mesh.
  void keep(Archive& archive);
  /// y = K x
  Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;

 private:
  struct TetPlaces {
    std::array<int, 4> order;   ///< the tetrahedron's corners by ascending node
    std::array<int, 10> block;  ///< of corners (order[i], order[j]), j ≤ i, row by row
  };
  void lay_out(const std::vector<std::vector<int>>& lower);
  void place_tets();
  bool holds(int i, int j) const;
  int place(int i, int j) const;

  std::vector<int> row_start_;  ///< of the lower triangle, by node
  std::vector<int> column_;     ///< ascending in each row; the diagonal last
  std::vector<Block> blocks_;   ///< of the symmetric part
  std::vector<Block> skew_;     ///< of the skew part; empty for a symmetric matrix
  std::vector<std::array<int, 4>> tets_;
  std::vector<TetPlaces> tet_places_;
  int extensions_ = 0;
};

}  // namespace palpate::implicit
