// Newton's linear equations K x = b by a factor that is kept: while K changes little, GMRES with the last factor as its preconditioner
// is cheaper than the next one. (Keyes and Knoll 2004, J. Comput. Phys. 193:357, on lagged preconditioners.) A factor that GMRES refines
// anyway is made in single precision. (Buttari, Dongarra, Kurzak, Luszczek, Tomov 2008, ACM Trans. Math. Softw. 34:17.)
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include <solver/implicit/block_matrix.hpp>
#include <solver/implicit/krylov.hpp>
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
  /// Solves in place to `tolerance` of the residual, rows weighted by `weights`, or better. A factor of K itself is made when there is
  /// none or when this one has cost as much as another would; in double precision where single does not lead there. A tolerance of 1 asks for the factor at hand, whatever K is by now. False when K is singular.
  bool solve(const BlockMatrix& K, const Eigen::VectorXd& weights, double tolerance, Eigen::VectorXd& x);
  /// Back-substitution, column by column, whatever K is by now.
  void apply(Eigen::Ref<Eigen::MatrixXd> x) { solver_.solve(x); }
  /// Whether the matrix factored last, if symmetric, has that many negative eigenvalues; where single precision says no, double decides, of K.
  bool has_negative_pivots(const BlockMatrix& K, int count);

  const Work& work() const { return work_; }
  int worth() const { return solver_.worth(); }
  void keep(Archive& archive);

 private:
  Krylov refine(const BlockMatrix& K, const Eigen::VectorXd& weights, double tolerance, int most, Eigen::VectorXd& x);

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
