// A symmetric sparse matrix of 4 × 4 blocks, one for every pair of nodes that share a tetrahedron; the lower triangle is kept.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <vector>

namespace palpate::implicit {

using Block = Eigen::Matrix4d;

class BlockMatrix {
 public:
  BlockMatrix(int nodes, const std::vector<std::array<int, 4>>& tets);

  void set_zero();
  /// Adds the block of nodes (i, j); (j, i) is its transpose and is not added separately.
  void add(int i, int j, const Block& block);

  int nodes() const { return static_cast<int>(row_start_.size()) - 1; }
  /// Lower-triangle entries in coordinate form, one-based, in a fixed order.
  void coordinates(std::vector<int>& rows, std::vector<int>& columns) const;
  /// Their values; rows and columns of `fixed` unknowns become those of the identity.
  void values(const std::vector<char>& fixed, std::vector<double>& out) const;
  /// y = K x
  Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;

 private:
  std::vector<int> row_start_;  ///< of the lower triangle, by node
  std::vector<int> column_;     ///< ascending in each row; the diagonal last
  std::vector<Block> blocks_;
};

}  // namespace palpate::implicit
