// Pattern from the mesh, values block by block.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/block_matrix.hpp>

#include <algorithm>

#include <solver/implicit/parallel.hpp>

namespace palpate::implicit {

BlockMatrix::BlockMatrix(int nodes, const std::vector<std::array<int, 4>>& tets, bool symmetric) : tets_(tets) {
  std::vector<std::vector<int>> lower(nodes);
  for (const auto& tet : tets)
    for (int i : tet)
      for (int j : tet)
        if (j < i) lower[i].push_back(j);
  for (auto& row : lower) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  lay_out(lower);
  if (!symmetric) skew_ = blocks_;
}

/// `lower`: the columns left of the diagonal, row by row, ascending. Values are zero afterwards.
void BlockMatrix::lay_out(const std::vector<std::vector<int>>& lower) {
  column_.clear();
  row_start_ = {0};
  for (int i = 0; i < static_cast<int>(lower.size()); ++i) {
    column_.insert(column_.end(), lower[i].begin(), lower[i].end());
    column_.push_back(i);
    row_start_.push_back(static_cast<int>(column_.size()));
  }
  blocks_.assign(column_.size(), Block::Zero());
  place_tets();
}

void BlockMatrix::place_tets() {
  tet_places_.clear();
  for (const auto& tet : tets_) {
    TetPlaces places{{0, 1, 2, 3}, {}};
    std::sort(places.order.begin(), places.order.end(), [&](int a, int b) { return tet[a] < tet[b]; });
    for (int i = 0, k = 0; i < 4; ++i)
      for (int j = 0; j <= i; ++j) places.block[k++] = place(tet[places.order[i]], tet[places.order[j]]);
    tet_places_.push_back(places);
  }
}

void BlockMatrix::keep(Archive& archive) {
  archive(row_start_, column_, blocks_, skew_, extensions_);
  if (archive.reading()) place_tets();
}

bool BlockMatrix::holds(int i, int j) const {
  const int at = place(i, j);
  return at < row_start_[i + 1] && column_[at] == j;
}

bool BlockMatrix::extend(const std::vector<std::array<int, 2>>& pairs) {
  if (std::all_of(pairs.begin(), pairs.end(), [&](const auto& pair) { return holds(pair[0], pair[1]); })) return false;
  std::vector<std::vector<int>> lower(nodes());
  for (int i = 0; i < nodes(); ++i) lower[i].assign(column_.begin() + row_start_[i], column_.begin() + row_start_[i + 1] - 1);
  for (const auto& [i, j] : pairs) lower[i].push_back(j);
  for (auto& row : lower) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  lay_out(lower);
  if (!symmetric()) skew_ = blocks_;
  ++extensions_;
  return true;
}

void BlockMatrix::set_zero(int threads) {
  in_shares(static_cast<int>(blocks_.size()), threads,
            [&](int from, int to) { std::fill(blocks_.begin() + from, blocks_.begin() + to, Block::Zero()); });
  std::fill(skew_.begin(), skew_.end(), Block::Zero());
}

/// Of the block of nodes (i, j), j ≤ i.
int BlockMatrix::place(int i, int j) const {
  const auto begin = column_.begin() + row_start_[i], end = column_.begin() + row_start_[i + 1];
  return static_cast<int>(std::lower_bound(begin, end, j) - column_.begin());
}

void BlockMatrix::add(int i, int j, const Block& block) {
  if (j > i) return add(j, i, block.transpose());
  blocks_[place(i, j)] += block;
}

void BlockMatrix::add_both(int i, int j, const Block& ij, const Block& ji) {
  if (j > i) return add_both(j, i, ji, ij);
  const int at = place(i, j);
  blocks_[at] += 0.5 * (ij + ji.transpose());
  if (!symmetric()) skew_[at] += 0.5 * (ij - ji.transpose());
}

void BlockMatrix::add_tet(int tet, const Eigen::Matrix<double, 16, 16>& matrix) {
  const auto& places = tet_places_[tet];
  for (int i = 0, k = 0; i < 4; ++i)
    for (int j = 0; j <= i; ++j) blocks_[places.block[k++]] += matrix.block<4, 4>(4 * places.order[i], 4 * places.order[j]);
}

void BlockMatrix::coordinates(std::vector<int>& rows, std::vector<int>& columns) const {
  rows.clear();
  columns.clear();
  for (int i = 0; i < nodes(); ++i)
    for (int at = row_start_[i]; at < row_start_[i + 1]; ++at)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < (column_[at] == i ? a + 1 : 4); ++b) {
          const int row = 4 * i + a + 1, column = 4 * column_[at] + b + 1;
          rows.push_back(row);
          columns.push_back(column);
          if (symmetric() || row == column) continue;
          rows.push_back(column);
          columns.push_back(row);
        }
}

void BlockMatrix::values(const std::vector<char>& fixed, std::vector<double>& out, int threads) const {
  // Of a diagonal block 10 of 16 entries are kept of a symmetric matrix; the others all, and both of a pair of blocks.
  const std::size_t per_block = symmetric() ? 16 : 32, less_on_diagonal = symmetric() ? 6 : 16;
  out.resize(per_block * column_.size() - less_on_diagonal * nodes());
  in_shares(nodes(), threads, [&](int from, int to) {
    double* value = out.data() + per_block * row_start_[from] - less_on_diagonal * from;
    for (int i = from; i < to; ++i)
      for (int at = row_start_[i]; at < row_start_[i + 1]; ++at)
        for (int a = 0; a < 4; ++a)
          for (int b = 0; b < (column_[at] == i ? a + 1 : 4); ++b) {
            const int row = 4 * i + a, column = 4 * column_[at] + b;
            const bool held = fixed[row] || fixed[column];
            const double skew = symmetric() ? 0 : skew_[at](a, b);
            *value++ = held ? double(row == column) : blocks_[at](a, b) + skew;
            if (!symmetric() && row != column) *value++ = held ? 0 : blocks_[at](a, b) - skew;
          }
  });
}

void BlockMatrix::add_to_displacements(double stiffness) {
  for (int i = 0; i < nodes(); ++i) blocks_[row_start_[i + 1] - 1].diagonal().head<3>().array() += stiffness;
}

Eigen::VectorXd BlockMatrix::multiply(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(4 * nodes());
  for (int i = 0; i < nodes(); ++i)
    for (int at = row_start_[i]; at < row_start_[i + 1]; ++at) {
      const int j = column_[at];
      y.segment<4>(4 * i) += blocks_[at] * x.segment<4>(4 * j);
      if (j != i) y.segment<4>(4 * j) += blocks_[at].transpose() * x.segment<4>(4 * i);
      if (symmetric()) continue;
      y.segment<4>(4 * i) += skew_[at] * x.segment<4>(4 * j);
      if (j != i) y.segment<4>(4 * j) -= skew_[at].transpose() * x.segment<4>(4 * i);
    }
  return y;
}

}  // namespace palpate::implicit
