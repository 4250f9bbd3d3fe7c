// Sparse factorisation by MUMPS: symmetric indefinite, L D Lᵀ, with its inertia; or general, L U. In double precision, or in single: half of
// the time and of the memory, for what is refined afterwards.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include <solver/archive.hpp>

namespace palpate::implicit {

enum class Precision { full, single };

class SparseDirect {
 public:
  /// Analyses the pattern, one-based; of a symmetric matrix the lower triangle. Unknowns come node by node, four each; METIS orders the nodes
  /// (Karypis and Kumar 1998, SIAM J. Sci. Comput. 20:359), alike in every run.
  SparseDirect(int unknowns, std::vector<int> rows, std::vector<int> columns, bool symmetric, int threads, Precision precision = Precision::full);
  ~SparseDirect();
  SparseDirect(SparseDirect&&) noexcept;
  SparseDirect& operator=(SparseDirect&&) noexcept;

  /// Numeric factorisation. False when the matrix is singular to working precision. Throws std::bad_alloc without memory.
  bool factor(const std::vector<double>& values);
  /// The pattern and the values factored last; read back, they are analysed and factored again: the same solutions to the bit.
  void keep(Archive& archive);
  Precision precision() const { return precision_; }
  /// Negative eigenvalues of the last factored matrix, if symmetric (Sylvester).
  int negative_pivots() const;
  /// What a factorisation costs, in solutions, by the analysis' counts of operations and of entries.
  int worth() const;
  /// Solves in place, column by column.
  void solve(Eigen::Ref<Eigen::MatrixXd> right_hand_sides);

 private:
  struct Mumps;
  Precision precision_;
  std::unique_ptr<Mumps> mumps_;
};

}  // namespace palpate::implicit
