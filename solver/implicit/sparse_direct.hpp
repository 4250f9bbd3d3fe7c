// Sparse factorisation by MUMPS: symmetric indefinite, L D Lᵀ, with its inertia; or general, L U.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include <solver/archive.hpp>

namespace palpate::implicit {

class SparseDirect {
 public:
  /// Analyses the pattern, one-based; of a symmetric matrix the lower triangle. The ordering is PORD's: SCOTCH's differs between runs.
  SparseDirect(int unknowns, std::vector<int> rows, std::vector<int> columns, bool symmetric, int threads);
  ~SparseDirect();
  SparseDirect(SparseDirect&&) noexcept;
  SparseDirect& operator=(SparseDirect&&) noexcept;

  /// Numeric factorisation. False when the matrix is singular to working precision. Throws std::bad_alloc without memory.
  bool factor(const std::vector<double>& values);
  /// The pattern and the values factored last; read back, they are analysed and factored again: the same solutions to the bit.
  void keep(Archive& archive);
  /// Negative eigenvalues of the last factored matrix, if symmetric (Sylvester).
  int negative_pivots() const;
  /// What a factorisation costs, in solutions, by the analysis' counts of operations and of entries.
  int worth() const;
  /// Solves in place, column by column.
  void solve(Eigen::Ref<Eigen::MatrixXd> right_hand_sides);

 private:
  struct Mumps;
  std::unique_ptr<Mumps> mumps_;
};

}  // namespace palpate::implicit
