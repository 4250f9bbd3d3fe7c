// Flexible GMRES with a preconditioner on the right, in a norm with weights of rows: min ‖W (b − A Z y)‖, Z = P⁻¹ V.
// Saad 1993, SIAM J. Sci. Comput. 14:461.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <functional>

namespace palpate::implicit {

struct Krylov {
  int iterations = 0;  ///< as many products and preconditionings
  bool found = false;
};

/// Solves in place: `x` is b before, x after, where found; else b still. `product`: A x; `precondition`: x ← P⁻¹ x. `weights`: of the rows.
/// Ends when the weighted residual is `tolerance` of that of x = 0.
Krylov gmres(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& product, const std::function<void(Eigen::VectorXd&)>& precondition,
             const Eigen::VectorXd& weights, double tolerance, int most, Eigen::VectorXd& x);

}  // namespace palpate::implicit
