// Newton's linear equations K x = b by a factor that is kept: while K changes little, GMRES with the last factor as its preconditioner
// is cheaper than the next one. (Keyes and Knoll 2004, J. Comput. Phys. 193:357, on lagged preconditioners.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include <solver/implicit/block_matrix.hpp>
#include <solver/implicit/sparse_direct.hpp>
#include <solver/implicit/work.hpp>

namespace palpate::implicit {

class KeptFactor {
 public:
  /// `fixed`: unknowns whose rows and columns are those of the identity. `keep`: false factors for every solution.
  KeptFactor(const BlockMatrix& K, std::vector<char> fixed, bool keep, int threads);

  /// Factors K; false when it is singular.
  bool renew(const BlockMatrix& K);
  /// K is another from now on.
  void outdate() { current_ = false; }
  /// Solves in place to `tolerance` of the residual, rows weighted by `weights`; exactly with a factor of K itself, which is made when there is
  /// none or when this one has cost as much as another would. A tolerance of 1 asks for the factor at hand, whatever K is by now. False when K is singular.
  bool solve(const BlockMatrix& K, const Eigen::VectorXd& weights, double tolerance, Eigen::VectorXd& x);
  /// Back-substitution, column by column, whatever K is by now.
  void apply(Eigen::Ref<Eigen::MatrixXd> x) { solver_.solve(x); }
  /// Of the matrix factored last, if symmetric.
  int negative_pivots() const { return solver_.negative_pivots(); }

  const Work& work() const { return work_; }
  int worth() const { return solver_.worth(); }
  void keep(Archive& archive);

 private:
  std::vector<char> fixed_;
  bool keep_;
  int threads_;
  SparseDirect solver_;
  int analysed_extensions_;  ///< of K's pattern, as the solver knows it
  bool held_ = false, current_ = false;
  int spent_ = 0;  ///< iterations with this factor
  Work work_;
};

}  // namespace palpate::implicit
