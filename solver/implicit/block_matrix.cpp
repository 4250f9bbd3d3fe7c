// Pattern from the mesh, values block by block.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/block_matrix.hpp>

#include <algorithm>

namespace palpate::implicit {

BlockMatrix::BlockMatrix(int nodes, const std::vector<std::array<int, 4>>& tets) {
  std::vector<std::vector<int>> lower(nodes);
  for (const auto& tet : tets)
    for (int i : tet)
      for (int j : tet)
        if (j < i) lower[i].push_back(j);
  row_start_.push_back(0);
  for (int i = 0; i < nodes; ++i) {
    auto& row = lower[i];
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    column_.insert(column_.end(), row.begin(), row.end());
    column_.push_back(i);
    row_start_.push_back(static_cast<int>(column_.size()));
  }
  blocks_.resize(column_.size());
  set_zero();
}

void BlockMatrix::set_zero() { std::fill(blocks_.begin(), blocks_.end(), Block::Zero()); }

void BlockMatrix::add(int i, int j, const Block& block) {
  if (j > i) return add(j, i, block.transpose());
  const auto begin = column_.begin() + row_start_[i], end = column_.begin() + row_start_[i + 1];
  blocks_[std::lower_bound(begin, end, j) - column_.begin()] += block;
}

void BlockMatrix::coordinates(std::vector<int>& rows, std::vector<int>& columns) const {
  rows.clear();
  columns.clear();
  for (int i = 0; i < nodes(); ++i)
    for (int at = row_start_[i]; at < row_start_[i + 1]; ++at)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < (column_[at] == i ? a + 1 : 4); ++b) {
          rows.push_back(4 * i + a + 1);
          columns.push_back(4 * column_[at] + b + 1);
        }
}

void BlockMatrix::values(const std::vector<char>& fixed, std::vector<double>& out) const {
  out.clear();
  for (int i = 0; i < nodes(); ++i)
    for (int at = row_start_[i]; at < row_start_[i + 1]; ++at)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < (column_[at] == i ? a + 1 : 4); ++b) {
          const int row = 4 * i + a, column = 4 * column_[at] + b;
          const bool held = fixed[row] || fixed[column];
          out.push_back(held ? double(row == column) : blocks_[at](a, b));
        }
}

Eigen::VectorXd BlockMatrix::multiply(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(4 * nodes());
  for (int i = 0; i < nodes(); ++i)
    for (int at = row_start_[i]; at < row_start_[i + 1]; ++at) {
      const int j = column_[at];
      y.segment<4>(4 * i) += blocks_[at] * x.segment<4>(4 * j);
      if (j != i) y.segment<4>(4 * j) += blocks_[at].transpose() * x.segment<4>(4 * i);
    }
  return y;
}

}  // namespace palpate::implicit
